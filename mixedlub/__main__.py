"""`python -m mixedlub` is `mixedlub`."""

import sys

from mixedlub.cli import main

sys.exit(main())
