"""Copy the small tables and main figures of studies from outputs/ to here: python docs/results/collect.py outputs."""

import shutil
import sys
from pathlib import Path

FIGURES = ("fig06_survival", "fig07_rewards", "fig09_safety", "fig11_paths", "policies", "attention_economics",
           "multiverse_shares", "multiverse_effects")
PAGES = ("curiosities", "generations")  # whole reports, some megabytes each
HERE = Path(__file__).parent

for study in sorted(Path(sys.argv[1]).iterdir()):
    report = study / "report"
    if not report.is_dir():
        continue
    target = HERE / study.name
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir()
    for table in sorted(report.glob("*.csv")):
        shutil.copy(table, target)
    for figure in sorted((report / "figures").glob("*.png")):
        if figure.stem in FIGURES or figure.stem.startswith("multiverse"):
            shutil.copy(figure, target)
    if study.name in PAGES:
        shutil.copy(report / "index.html", target / "report.html")
    print(study.name, *sorted(file.name for file in target.iterdir()))
