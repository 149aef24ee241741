# `make study` answers, `make test` checks; both prepare the machine first.
CARGO ?= cargo
# Anything for the study, for example: make study STUDY="ball --method blended"
STUDY ?=

# Mesa's device-selection layer would complain about a missing desktop session.
export NODEVICE_SELECT = 1

.PHONY: help setup study test test-all

help:
	@echo "make study     judge every method on every default scene: table, report, images"
	@echo "make test      all tests but the slow ones"
	@echo "make test-all  all tests"
	@echo "make setup     only prepare the machine (both of the above do it)"

setup:
	@./setup.sh

study: setup
	$(CARGO) run --release -p snell -- study --out target/study $(STUDY)

test: setup
	$(CARGO) test --release --workspace

test-all: setup
	$(CARGO) test --release --workspace -- --include-ignored
