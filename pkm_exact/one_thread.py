"""One thread for linear algebra: matrices here are small, and several threads gain nothing.

On cores with other work to do, threads wait for each other many times as long as the work takes.
"""

from __future__ import annotations

import os
from typing import Final

THREADS: Final = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
"""Variables that libraries of linear algebra obey when they are loaded."""


def prefer_one_thread() -> list[str]:
    """Have linear algebra that is loaded later, here or in processes to be started, done in one thread.

    Returns
    -------
    list of str
        The variables that are set; those of the user stay as they are.
    """
    missing = [name for name in THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(missing, "1"))
    return missing
