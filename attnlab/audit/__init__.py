"""Can the cells of a summary table be true together?

    python -m attnlab.audit                 # Table 5 of the paper
    python -m attnlab.audit mine.yaml

The model's bookkeeping is exact (identities and bounds of eqs 5, 6, 10, 13), so averages over episodes must obey it.
"""
