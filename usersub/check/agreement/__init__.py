# SPDX-License-Identifier: MIT
"""A routine against the built-in law that it claims to be."""
