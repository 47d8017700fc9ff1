"""Before numpy is loaded: many small matrices are solved faster by one thread, as the command line does."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
