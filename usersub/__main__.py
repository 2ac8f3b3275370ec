# SPDX-License-Identifier: MIT
"""`python -m usersub`."""

from usersub.cli.main import main

if __name__ == "__main__":
    main()
