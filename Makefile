# Each target sets up what it needs in .venv, once, and again only when pyproject.toml changes.

PYTHON ?= python3
BIN := .venv/bin
QUICK ?=
# Tests start hundreds of programs, each of which would compile the package anew.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: study test bench prove check docs lint types examples

study: .venv/base
	$(BIN)/mixedlub study examples/study_21_pairings.toml --paper-figures --out out/study

# Threads of linear algebra in each worker would wait for each other.
test: .venv/dev
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n auto --dist worksteal

bench: .venv/dev
	@for file in benchmarks/*.py; do $(BIN)/python $$file || exit 1; done

# QUICK leaves out the long tests and takes few cases.
prove: .venv/dev
	$(if $(QUICK),,OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n auto -m long)
	$(BIN)/mixedlub prove --out out/prove $(if $(QUICK),--quick)
	$(BIN)/mixedlub prove --rigs --out out/prove_rigs $(if $(QUICK),--quick)
	$(if $(QUICK),,$(BIN)/mixedlub prove --real benchmarks/recordings --out out/prove_real)

check: lint types examples

# Every command and program on the pages runs here, and one that fails stops the build; nothing is fetched.
docs: .venv/dev
	$(BIN)/sphinx-build --fresh-env --nitpicky --fail-on-warning --keep-going --quiet --jobs auto \
	    --doctree-dir out/doctrees docs out/docs
	@echo "pages in out/docs/index.html"

lint: .venv/dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: .venv/dev
	$(BIN)/mypy

# Examples run from a copy elsewhere, so that they use the installed package and no file they do not bring.
examples: .venv/dev
	@copy=$$(mktemp -d) && cp -r examples/. $$copy && here=$$(pwd) && cd $$copy && \
	for file in [0-9]*.py; do echo "examples/$$file"; $$here/$(BIN)/python -W error -W default:caution -W default:doubt $$file > $$file.log || exit 1; done; \
	rm -rf $$copy

.venv/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	    { echo "Python 3.11 or later is needed; name it with make PYTHON=..."; exit 1; }
	@$(PYTHON) -m venv --clear .venv > /dev/null 2>&1 || \
	    { echo "python3-venv is missing; installing it"; apt-get install -y python3-venv > /dev/null && \
	      $(PYTHON) -m venv --clear .venv; } || \
	    { echo "install Debian's python3-venv, then try again"; exit 1; }
	@touch $@

.venv/base: pyproject.toml | .venv/pip
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[interactive]'
	@touch $@

.venv/dev: pyproject.toml | .venv/pip
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@touch $@ .venv/base
