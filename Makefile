# `make study` answers, `make test` checks; both prepare the machine first.
CARGO ?= cargo
# Anything for the study, for example: make study STUDY="ball --method blended"
STUDY ?=

# Mesa's device-selection layer would complain about a missing desktop session.
export NODEVICE_SELECT = 1

# Anything for the gate, for example: make gate GATE="--only ball"
GATE ?= --quick

.PHONY: help setup study gate test test-all python

help:
	@echo "make study     judge every method on every default scene: table, report, images"
	@echo "make gate      hold every watched method to what was accepted"
	@echo "make test      all tests but the slow ones"
	@echo "make test-all  all tests"
	@echo "make python    only the tests of the Python package, from a wheel of its own"
	@echo "make setup     only prepare the machine (both of the above do it)"

setup:
	@./setup.sh

study: setup
	$(CARGO) run --release -p snell -- study --out target/study $(STUDY)

gate: setup
	$(CARGO) run --release -p snell -- check compare/results/gate/gate.toml --out target/gate-out \
		--junit target/gate-out/junit.xml $(GATE)

test: setup
	$(CARGO) test --release --workspace
	@compare/python/check.sh

test-all: setup
	$(CARGO) test --release --workspace -- --include-ignored
	@compare/python/check.sh

python: setup
	@compare/python/check.sh
