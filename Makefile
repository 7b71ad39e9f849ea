# Rapidity. `make ride` and `make test` are all one needs; each does only what is missing.

CARGO ?= cargo

# Option by which cargo runs programs beside a simulated headset.
IN_MONADO = --config 'target."cfg(unix)".runner = ["$(CURDIR)/scripts/monado", "run"]'

.PHONY: help ride test test-headset bench bench-headset fuzz docs clean

help: ## What can be made
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /make \1\t/'

ride: ## Install what the system lacks, build, and ride; without a display, film 10 s of it into ride.mp4
	@scripts/install ride
	$(CARGO) run --release --bin rapidity -- ride $(ARGS)

test: ## Install what the tests need, and run every test
	@scripts/install test
	$(CARGO) test --release --workspace

test-headset: ## Try rides with a headset on a real OpenXR runtime; makes that once (190 MB to load, 1 GB on the disk)
	@scripts/install test
	scripts/monado root
	$(CARGO) $(IN_MONADO) test --release -p system-tests -p rapidity --test headset -- --test-threads=1

bench: ## Measure: kernel against copy bandwidth, integrators, frames
	@scripts/install test
	$(CARGO) bench --workspace

bench-headset: ## Measure a ride in a simulated headset against the same two views in a window
	@scripts/install test
	scripts/monado root
	$(CARGO) $(IN_MONADO) bench -p rapidity --bench headset

fuzz: ## Try damaged files and lines of every kind, a minute each (SECONDS=…): nothing may panic or hang
	$(CARGO) run --release -p rapidity --example fuzz -- $(or $(SECONDS),60)

docs: ## Build the documentation of all crates
	$(CARGO) doc --workspace --no-deps

clean: ## Remove what was built
	$(CARGO) clean
