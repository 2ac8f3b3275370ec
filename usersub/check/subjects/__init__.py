# SPDX-License-Identifier: MIT
"""From what somebody wants checked to subjects: loading, and finding out what is not said."""
