PROGRAM := $(or $(CARGO_TARGET_DIR),target)/release/cyclestart
EXAMPLE := examples/plate.nc --setup examples/plate.setup.toml

help: ## this list
	@grep -E '^[a-z-]+:.*## ' Makefile | sed -E 's/^([a-z-]+):.*## /make \1	/' | expand -t 16

run: build ## build, run the example program, draw its picture
	$(PROGRAM) run $(EXAMPLE)
	@mkdir -p run && $(PROGRAM) plot $(EXAMPLE) -o run/plate.svg && $(PROGRAM) plot $(EXAMPLE) -o run/plate.png
	@echo "The picture: run/plate.svg and run/plate.png"

build: cargo ## the program, at target/release/cyclestart
	cargo build --release --locked

fast: cargo ## the same trained on its own runs, almost twice as fast, at target/fast/release/cyclestart
	python3 benches/fast.py

test: format lint unit docs checks ## everything that CI runs

format: cargo
	cargo fmt --all --check
	cargo fmt --manifest-path fuzz/Cargo.toml --check

IN_TESTS := disallowed-methods expect-used unwrap-used panic

lint: cargo # tests may panic, read files, and take the standard library's sine as a second opinion; fuzz/ needs no C++ here
	cargo clippy --workspace --locked -- -D warnings
	cargo clippy --workspace --all-targets --locked -- -D warnings $(addprefix -A clippy::,$(IN_TESTS))
	CUSTOM_LIBFUZZER_PATH=/dev/null cargo check --manifest-path fuzz/Cargo.toml --locked --target-dir $(or $(CARGO_TARGET_DIR),target)

unit: cargo
	cargo test --workspace --all-targets --locked --no-fail-fast

docs: cargo
	cargo test --workspace --doc --locked
	RUSTDOCFLAGS=-Dwarnings cargo doc --workspace --no-deps --locked

checks: cargo
	python3 ci/house.py
	python3 ci/licences.py
	python3 ci/pages.py --check
	python3 ci/pictures.py --check
	set -e; for control in yasnac-mx1 incon-m84 incon-m86 incon-m86r; do \
		cargo run --quiet --locked -p cyclestart -- controls $$control --coverage > /dev/null; done
	python3 -m unittest discover -q ci

bench: fast ## measure: speed beside a peer, memory; prints command, sample, figure, limit
	python3 benches/check_surface.py
	python3 benches/drill.py
	python3 benches/macro_loop.py
	python3 benches/memory.py
	python3 benches/compensation.py
	python3 benches/shift.py
	python3 benches/progress.py
	python3 benches/beside_linuxcnc.py
	python3 benches/linuxcnc_times.py
	python3 benches/planner.py
	python3 benches/limits.py 1000
	python3 benches/operating.py
	python3 benches/handshake.py
	WALK=1000000 python3 benches/random_walk.py
	python3 benches/power_cuts.py 1000
	python3 benches/optimum.py
	python3 benches/contours.py 100000
	python3 benches/realtime.py

fuzz: cargo ## throw random programs at the reader and at the whole interpreter, FUZZ_SECONDS=60 each
	ci/fuzz.sh read
	ci/fuzz.sh interpret
	ci/fuzz.sh macros
	ci/fuzz.sh tape
	ci/fuzz.sh compensation

cases: cargo ## write what the program now prints into cases/; the diff is the review
	UPDATE_CASES=1 cargo test -p cyclestart --test cases --locked

pages: ## write the programmer's pages docs/*/ from tables and cases
	python3 ci/pages.py

pictures: cargo ## draw the pictures of docs/ again
	python3 ci/pictures.py

clean: ## remove all that was built
	rm -rf target run fuzz/target fuzz/corpus fuzz/artifacts

cargo:
	@command -v cargo >/dev/null || { echo "Rust's cargo is missing: rustup.rs says how to install it (one line)."; exit 1; }

.PHONY: help run build fast test format lint unit docs checks bench fuzz cases pages pictures clean cargo
