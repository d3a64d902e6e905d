# What to type in a fresh checkout: `make demo`, `make test`, `make lint`.
# Everything is installed into .venv; nothing else is touched.

PYTHON ?= python3
EXTRAS ?= test,lint
VENV := .venv
PIP := $(VENV)/bin/pip --disable-pip-version-check
# One stamp for each set of extras: another set is another installation.
STAMP := $(VENV)/.installed
# Tests run in so many processes, a file in one.
WORKERS ?= 2
PYTEST := $(VENV)/bin/python -m pytest -q -n $(WORKERS) --dist loadfile
ALL := $(STAMP)-$(EXTRAS)
# What is compiled when the package is installed, and with what.
KERNELS := $(shell grep -rl --include='*.py' '^import cython$$' gazelle) \
	$(shell find gazelle -name '*.pxd' -o -name '*.h') setup.py $(wildcard tools/packaging/*.py)

.PHONY: help setup demo test test-slow ros-suites lint bench clean

help:
	@echo "make demo       train and evaluate a TurtleBot3 from its files (2 minutes)"
	@echo "make test       set up and run every quick test"
	@echo "make test-slow  the long checks too"
	@echo "make ros-suites ROS 1's own test suites against Gazelle (Debian 12, 20 minutes)"
	@echo "make setup      .venv with everything, nothing run"
	@echo "make lint       ruff (check and format) and mypy in strict mode"
	@echo "make bench      the benchmark of the environments"
	@echo "make clean      remove .venv and caches"

$(VENV)/bin/python:
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Gazelle needs Python 3.11 or newer; set PYTHON=python3.11 or so")'
	$(PYTHON) -m venv $(VENV)

$(STAMP)-demo: $(VENV)/bin/python pyproject.toml constraints.txt $(KERNELS)
	$(PIP) install --quiet --constraint constraints.txt --editable '.[train]'
	@touch $@

$(ALL): $(VENV)/bin/python pyproject.toml constraints.txt $(KERNELS)
	$(PIP) install --quiet --constraint constraints.txt --editable '.[$(EXTRAS)]'
	@touch $@

setup: $(ALL)

demo: $(STAMP)-demo
	$(VENV)/bin/gazelle demo

test: $(ALL)
	$(PYTEST) -m "not slow"

test-slow: $(ALL)
	GAZELLE_EXAMPLES=fresh $(PYTEST)

# ROS_SOURCES names a folder with checkouts; without it, Debian's source packages are fetched.
ros-suites: $(ALL)
	$(VENV)/bin/python tools/ros_suites.py $(if $(ROS_SOURCES),--sources $(ROS_SOURCES),--fetch)

lint: $(ALL)
	$(VENV)/bin/ruff check
	$(VENV)/bin/ruff format --check
	$(VENV)/bin/mypy

bench: $(ALL)
	$(PIP) install --quiet --constraint constraints.txt --editable '.[bench]'
	$(VENV)/bin/gazelle bench env

clean:
	rm -rf $(VENV) build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
