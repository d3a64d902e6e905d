# What to type in a fresh checkout: `make demo`, `make test`, `make lint`.
# Everything is installed into .venv; nothing else is touched.

PYTHON ?= python3
EXTRAS ?= test,lint
VENV := .venv
PIP := $(VENV)/bin/pip --disable-pip-version-check
# Also for what builds the package, which pip installs aside.
export PIP_CONSTRAINT := $(CURDIR)/constraints.txt
# One stamp for each set of extras: another set is another installation.
STAMP := $(VENV)/.installed
# Tests run in so many processes, a file in one.
# Many tests wait: three processes keep two processors busy.
WORKERS ?= 3
# Which tests: files, folders, or @FILE with a line for each. Without them all.
TESTS ?=
PYTEST := $(VENV)/bin/python tools/run_tests.py -q -n $(WORKERS) --dist loadfile
ALL := $(STAMP)-$(EXTRAS)
# What is compiled when the package is installed, and with what.
KERNELS := $(shell grep -rl --include='*.py' '^import cython$$' gazelle) \
	$(shell find gazelle -name '*.pxd' -o -name '*.h') setup.py $(wildcard tools/compiling/*.py)

# What runs most of what is compiled, in little time.
KERNEL_TESTS := tests/native/test_loop.py tests/geometry/test_air_probes.py tests/formats/test_octree.py tests/engines/mujoco/test_contact_laws.py tests/engines/mujoco/test_plane_cylinder.py \
	tests/engines/mujoco/test_rolling_contacts.py tests/engines/planar/test_scans.py tests/engines/planar/test_small_scenes.py tests/engines/planar/test_fleet.py tests/engines/planar/test_sweeping.py tests/sensors/test_lidar_ranges.py tests/simulation/test_many_robots.py tests/rendering/test_renderer.py \
	tests/kinematics/test_inverse.py tests/kinematics/test_kinematics.py tests/planning/test_timing.py \
	tests/navigation/costmap tests/navigation/planners tests/navigation/localization/test_pose_bins.py tests/navigation/localization/test_scan_likelihood.py
BUILD_INPLACE = $(VENV)/bin/python setup.py --quiet build_ext --inplace
ON_KERNELS = $(VENV)/bin/python -m pytest -q -n $(WORKERS) --dist loadfile -m "not slow" -p no:cacheprovider \
	-k "not gets_there_and_hits_nothing" -W error::pytest.PytestUnraisableExceptionWarning $(KERNEL_TESTS)

.PHONY: help setup demo test test-slow ros-suites release-check lint docs bench checked wheel clean

help:
	@echo "make demo       train and evaluate a TurtleBot3 from its files (2 minutes)"
	@echo "make test       set up and run every quick test (6 minutes on two processors); TESTS=tests/ros runs these"
	@echo "make test-slow  the longer ones too, those that CI runs and all others"
	@echo "make ros-suites ROS 1's own test suites against Gazelle (Debian 12, 20 minutes)"
	@echo "make release-check  measure all that is published again (hours; goes on where it stopped)"
	@echo "make setup      .venv with everything, nothing run"
	@echo "make lint       ruff (check and format) and mypy in strict mode"
	@echo "make docs       the documentation as a site, in build/docs; warnings are errors"
	@echo "make bench      the benchmark of the environments"
	@echo "make checked    kernels' tests with checked indices and sanitizers (gcc)"
	@echo "make wheel      wheels for Linux, macOS and Windows into dist, with Zig's C compiler"
	@echo "make clean      remove .venv and caches"

$(VENV)/bin/python:
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Gazelle needs Python 3.11 or newer; set PYTHON=python3.11 or so")'
	$(PYTHON) -m venv $(VENV)

$(STAMP)-demo: $(VENV)/bin/python pyproject.toml packages/gazelle-ros/pyproject.toml constraints.txt $(KERNELS)
	$(PIP) install --quiet --constraint constraints.txt --editable packages/gazelle-ros --editable '.[train]'
	@touch $@

$(ALL): $(VENV)/bin/python pyproject.toml packages/gazelle-ros/pyproject.toml constraints.txt $(KERNELS)
	$(PIP) install --quiet --constraint constraints.txt --editable packages/gazelle-ros --editable '.[$(EXTRAS)]'
	@touch $@

setup: $(ALL)

demo: $(STAMP)-demo
	$(VENV)/bin/gazelle demo

test: $(ALL)
	$(PYTEST) -m "not slow and not long" $(TESTS)

test-slow: $(ALL)
	GAZELLE_EXAMPLES=fresh $(PYTEST)

# ROS_SOURCES names a folder with checkouts; without it, Debian's source packages are fetched.
ros-suites: $(ALL)
	$(VENV)/bin/python tools/ros_suites.py $(if $(ROS_SOURCES),--sources $(ROS_SOURCES),--fetch)

# ONLY names steps, such as ONLY="'recipe Kobuki*' 'slow tests of ros'".
release-check: $(ALL)
	$(PIP) install --quiet --constraint constraints.txt --editable packages/gazelle-ros --editable '.[bench]'
	$(VENV)/bin/python tools/release_check.py $(if $(ONLY),--only $(ONLY))

lint: $(ALL)
	$(VENV)/bin/ruff check
	$(VENV)/bin/ruff format --check
	$(VENV)/bin/mypy

$(STAMP)-docs: $(VENV)/bin/python pyproject.toml packages/gazelle-ros/pyproject.toml constraints.txt $(KERNELS)
	$(PIP) install --quiet --constraint constraints.txt --editable packages/gazelle-ros --editable '.[docs]'
	@touch $@

docs: $(if $(findstring docs,$(EXTRAS)),$(ALL),$(STAMP)-docs)
	$(VENV)/bin/sphinx-build --quiet --fail-on-warning --keep-going --jobs auto docs build/docs

bench: $(ALL)
	$(PIP) install --quiet --constraint constraints.txt --editable packages/gazelle-ros --editable '.[bench]'
	$(VENV)/bin/gazelle bench env

checked: $(ALL)
	GAZELLE_BUILD=checked $(BUILD_INPLACE)
	GAZELLE_NATIVE=checked ASAN_OPTIONS=detect_leaks=0 \
		LD_PRELOAD="$$(gcc -print-file-name=libasan.so) $$(gcc -print-file-name=libubsan.so)" $(ON_KERNELS)

# TARGETS names platforms of tools/compiling/wheels.py; without it all are built.
wheel: $(ALL)
	$(PIP) install --quiet --constraint constraints.txt abi3audit auditwheel build twine ziglang
	$(VENV)/bin/python tools/compiling/wheels.py dist $(TARGETS)

clean:
	rm -rf $(VENV) build packages/gazelle-ros/build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
