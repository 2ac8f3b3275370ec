# SPDX-License-Identifier: MIT
"""Ways of asking a routine: raw calls, checked drivers, other processes, differences."""
