# Every target sets up what it needs, from nothing but Python 3.11, make and git.
PYTHON ?= $(shell command -v python3.11 || command -v python3)
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

.PHONY: help demo test lint format bench docs-pictures lock clean

help: ## say what there is
	@grep -E '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

$(READY): pyproject.toml requirements.lock
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "sketchloft needs Python 3.11 or newer; set PYTHON=")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --editable .
	touch $@

demo: $(READY) ## cloud, model, pictures and report of three spheres, in demo/
	$(BIN)/python examples/demo.py

test: $(READY) ## the whole test suite
	$(BIN)/python -m pytest -n auto

lint: $(READY) ## format, lint and types, as in CI
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

format: $(READY) ## put the code into its format
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(READY) ## times of every stage at 10^4, 10^5 and 10^6 points; error and time beside other methods
	$(BIN)/python benchmarks/stages.py
	$(BIN)/python benchmarks/peers.py

docs-pictures: $(READY) ## every picture in the README and the docs
	$(BIN)/python docs/pictures.py

lock: ## requirements.lock from pyproject.toml (needs uv)
	uv pip compile --quiet --python-version 3.11 --group dev --no-emit-index-url --no-annotate --no-header \
		pyproject.toml -o requirements.lock

clean: ## what the other targets made
	rm -rf $(VENV) demo dist .mypy_cache .ruff_cache .pytest_cache .hypothesis
