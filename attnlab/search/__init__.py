"""Is there any reading in which the paper is true? A search over all combinations of its open points.

    python -m attnlab.search --minutes 60
    python -m attnlab.search --rungs 400:2:120,100:4:250,40:6:500

Rungs (successive halving, Jamieson and Talwalkar 2016): many readings with few seeds and short lives, scored by the
signs of effects; the best of them, and what is bred from them, with more; only the finalists are judged by the claims
themselves, on fresh seeds that took no part.
"""
