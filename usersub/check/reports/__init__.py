# SPDX-License-Identifier: MIT
"""Reports as data, as text and as JUnit XML."""
