# SPDX-License-Identifier: MIT
# Task runner. `make build PYTHON=/path/to/python` works in another environment.
PYTHON ?= python
PYTEST_ARGS ?=
STUDY_ARGS ?=
C_SOURCES = $(wildcard csrc/checked/*.[ch] csrc/driver/*.[ch] csrc/probe/*.[ch] csrc/runtime/*.[ch] csrc/python/*.c csrc/include/usersub/*.h csrc/include/usersub/law/*.h)

.PHONY: help build gen check-gen test lint format docs bench instructions problems study conformance mutation clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 12

build: ## compile the C core and install the package in editable form
	$(PYTHON) -m pip install --quiet --no-build-isolation --no-deps -e .

gen: ## write the generated files
	$(PYTHON) -m usersub.emit

check-gen: ## compare the generated files with the tables
	$(PYTHON) -m usersub.emit --check

test: ## run the tests (PYTEST_ARGS="-k name")
	$(PYTHON) -m pytest $(PYTEST_ARGS)

lint: ## ruff, clang-format, mypy
	$(PYTHON) -m ruff check .
	$(PYTHON) -m ruff format --check .
	clang-format --dry-run -Werror $(C_SOURCES)
	$(PYTHON) -m mypy

format: ## format Python and C
	$(PYTHON) -m ruff check --fix .
	$(PYTHON) -m ruff format .
	clang-format -i $(C_SOURCES)

docs: ## build the documentation, warnings are errors
	$(PYTHON) -m sphinx -q -W --keep-going -b html docs docs/_build/html

bench: ## run the benchmarks and write the pages of benchmarks and cost
	$(PYTHON) -m tests.benchmarks

instructions: ## count the instructions of the drivers and compare with those on record
	$(PYTHON) -m tests.benchmarks.instructions

problems: ## measure the problems with known answers and write their pages
	$(PYTHON) -m usersub.problems --markdown docs/explanation/problems.md
	$(PYTHON) -m usersub.problems --newton docs/explanation/newton.md

study: ## measure accuracy, stability and cost, and write their pages (a quarter of an hour; STUDY_ARGS=--quick)
	$(PYTHON) -m usersub study --out build/study $(STUDY_ARGS)
	$(PYTHON) -m usersub.study.accuracy build/study/results.json docs/explanation
	$(PYTHON) -m usersub.study.stability.chapter docs/explanation --keep build/study $(STUDY_ARGS)
	$(PYTHON) -m tests.benchmarks

conformance: ## run all rules over planted faults and built-in laws, and write their page
	$(PYTHON) -m tests.meta.table

mutation: ## break the built-in laws in small ways, see what the rules find, and write its page
	$(PYTHON) -m tests.meta.mutation --write

clean: ## remove what was built
	rm -rf build dist docs/_build .pytest_cache .mypy_cache .ruff_cache .hypothesis
