# SPDX-License-Identifier: MIT
"""What the source and the object file of a routine say, without running it."""
