# SPDX-License-Identifier: MIT
"""Rules in child processes: what is looked at where, what a dead child means, smaller cases."""
