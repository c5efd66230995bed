# cyclestart: each target one line that a reader understands.
CARGO := $(shell command -v cargo || echo "echo 'cargo is missing: install Rust 1.95 or later from https://rustup.rs' >&2; false")
CYCLESTART := target/release/cyclestart
EXAMPLE := examples/plate.nc --setup examples/plate.setup.toml

.PHONY: help run test build cases clean
help: ## say what there is
	@grep -E '^[a-z]+:.*##' Makefile | sed -E 's/:.*## /	/'

build: ## leave the program at target/release/cyclestart
	$(CARGO) build --release --locked --package cyclestart

run: build ## run the example program on the virtual machine and draw its tool path
	@mkdir -p run
	$(CYCLESTART) run $(EXAMPLE)
	@$(CYCLESTART) plot $(EXAMPLE) --output run/plate.svg
	@$(CYCLESTART) plot $(EXAMPLE) --output run/plate.png
	@echo "The picture of the tool path: run/plate.png (and run/plate.svg)"

test: ## everything that CI runs
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	$(CARGO) test --workspace --locked
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps --locked --document-private-items

cases: ## rewrite the expectations of cases/ from what the program prints; the diff is the review
	UPDATE_CASES=1 $(CARGO) test --package cyclestart --test cases

clean: ## remove what was built
	$(CARGO) clean
