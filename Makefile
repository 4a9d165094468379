# SPDX-License-Identifier: GPL-3.0-or-later
#
# A thin front to meson and ninja. On Debian, what is missing to build or to test is installed first.

BUILD = build
MODEL = models/kinetics/incline.yaml
MESON_OPTIONS =

# Programs and library, which is all that is installed; tests are built by the targets that run them.
all: $(BUILD)/build.ninja
	ninja -C $(BUILD) programs

run: all
	$(BUILD)/apps/fbd-run $(MODEL)

test: $(BUILD)/.tests
	ninja -C $(BUILD)
	.ci/test $(BUILD) --no-rebuild

sanitize: $(BUILD)-sanitize/.tests
	ninja -C $(BUILD)-sanitize
	.ci/test $(BUILD)-sanitize --no-rebuild

# Threads that share a model, and a sweep by four of them, under ThreadSanitizer.
tsan: $(BUILD)-tsan/.tests
	ninja -C $(BUILD)-tsan tests/unit/test_threads apps/fbd-sweep
	FBD_TEST_TIMEOUT=10 .ci/test $(BUILD)-tsan --no-rebuild threads
	TSAN_OPTIONS=halt_on_error=1 $(BUILD)-tsan/apps/fbd-sweep --jobs 4 --vary 'phi=0:60 deg:20' --vary 'mu_k=uniform(0.1,0.4):10' \
		models/kinetics/incline.yaml >$(BUILD)-tsan/by-four.csv
	$(BUILD)-tsan/apps/fbd-sweep --jobs 1 --vary 'phi=0:60 deg:20' --vary 'mu_k=uniform(0.1,0.4):10' \
		models/kinetics/incline.yaml >$(BUILD)-tsan/by-one.csv
	cmp $(BUILD)-tsan/by-four.csv $(BUILD)-tsan/by-one.csv

valgrind: $(BUILD)/.tests
	ninja -C $(BUILD)
	.ci/test $(BUILD) --no-rebuild --setup valgrind --suite unit --suite hard

# The core alone, and with each satellite and those that it needs, each built by itself and tested; some minutes.
satellites:
	.ci/install-packages run test
	tests/tools/satellites $(BUILD)-satellites

# Every file with which something was once wrong (tests/faults/EXPECTED), and how many claims held.
faults: $(BUILD)/.tests
	ninja -C $(BUILD)
	.ci/test $(BUILD) --no-rebuild --suite faults

# Invents inputs for the targets of tests/fuzz, for so many seconds in all. With RUNS, that many for whole runs and
# others in proportion: without AddressSanitizer, which takes most of the time, and then a tenth as many with it.
SECONDS = 300
RUNS =

ifeq ($(RUNS),)
fuzz: $(BUILD)-fuzz/build.ninja
	.ci/install-packages run fuzz
	ninja -C $(BUILD)-fuzz
	tests/fuzz/run $(BUILD)-fuzz $(SECONDS)
else
fuzz: $(BUILD)-fuzz/build.ninja $(BUILD)-count/build.ninja
	.ci/install-packages run fuzz
	ninja -C $(BUILD)-count
	tests/fuzz/run $(BUILD)-count --runs=$(RUNS)
	ninja -C $(BUILD)-fuzz
	tests/fuzz/run $(BUILD)-fuzz --runs=$$(($(RUNS) / 10))
endif

# fbd-run for other machines, by cross compilers and qemu: TARGETS of i686 (32 bits), s390x (big endian), musl, windows (by wine). Every model of
# the gallery does there what it does here. Some minutes for each.
TARGETS = i686
portability: all
	.ci/install-packages run portability
	tests/tools/portability $(BUILD) $(BUILD)-portability $(TARGETS)

# Each fault of tests/mutants/list, put into a copy of the sources, has to be noticed by a test; some half an hour.
mutants:
	.ci/install-packages run test
	tests/mutants/run $(BUILD)-mutants

# Random scenes against the independent assembly of tests/cross, with seeds that the tests do not use.
SCENES = 100000
SEED = 1000000
# Scenes of one kind alone: tracks, slots, windings, masses, rolls or spools.
KIND =
cross-check: $(BUILD)/.tests
	ninja -C $(BUILD)
	$(BUILD)/tests/cross/cross_check --scenes $(SCENES) --seed $(SEED) --variants 10 --rest 4 --jobs 2 $(if $(KIND),--of $(KIND))

# What differs from another revision, BASE, in the gallery with all outputs, in the files of the tests and in random
# scenes: outcomes, events, states, works, texts, instructions (tests/tools/compare). BASE may be a build that is there
# already; its programs are built into build-compare, once. COMPARE has further options: `--only hoist`, `--all`, ...
BASE =
COMPARE =
compare: SCENES = 300
compare: SEED = 1
compare: $(BUILD)/.tests
	@[ -n "$(BASE)" ] || { echo 'usage: make compare BASE=REVISION [SCENES=10000] [SEED=7] [COMPARE=--all]' >&2; exit 2; }
	ninja -C $(BUILD) apps/fbd-run apps/fbd-sweep tests/cross/cross_check
	python3 tests/tools/compare $(BASE) --build $(BUILD) --folder $(BUILD)-compare --scenes $(SCENES) --seed $(SEED) \
		--meson "$(LIBDIR) $(MESON_OPTIONS)" $(COMPARE)

# Tests whose scenes, values or texts are drawn, with DRAWS times as many as in every change; some two minutes.
DRAWS = 5
GENERATORS = actuators cams carried_slides cases contact_tolerances corners dead_centres decks drawn_answers driven emit_drawn hints \
	hoists hand_impacts hand_run impulses level_floors linearize_couplings lines long_pendulum motors nasty nonunique notation_drawn not_finite pairs piles place_works plane printed_lines pulled_row \
	reactions redundant_pins residual rolls scales sheets shelf sliding slots stick_slips stiff_motions surface_speed sweep switch_holds symbolic_lines \
	wheels works written_systems
generators: $(BUILD)/.tests
	ninja -C $(BUILD)
	FBD_DRAWS=$(DRAWS) FBD_TEST_TIMEOUT=$(DRAWS) .ci/test $(BUILD) --no-rebuild $(GENERATORS)

# What is promised of speed, measured: writes docs/accuracy.md and one table of all bounds, $(BUILD)/bench.md; some
# minutes. `make measurements` is for what judges nothing.
bench: $(BUILD)/.tests
	ninja -C $(BUILD)
	tests/bench/table $(BUILD) docs/accuracy.md

measurements: $(BUILD)/.tests
	ninja -C $(BUILD)
	meson test -C $(BUILD) --no-rebuild --benchmark --verbose

# Counts instructions anew and puts them into docs/effects.md.
effects: $(BUILD)/.tests
	ninja -C $(BUILD)
	FBD_SOURCE_ROOT=$(CURDIR) FBD_RUN=$(BUILD)/apps/fbd-run FBD_COUNT_RHS=$(BUILD)/tests/bench/count_rhs \
		tests/tools/effects --write docs/effects.md

# Records the instructions of five runs, of which no change may take a tenth more (tests/tools/instructions).
instructions: $(BUILD)/.tests
	ninja -C $(BUILD) programs
	meson test -C $(BUILD) --no-rebuild --test-args=--write instructions

# 155,000 random scenes whose lists of events are known; takes some minutes.
events: $(BUILD)/.tests
	ninja -C $(BUILD) tests/unit/test_events tests/unit/test_joined_events
	FBD_EVENT_SCENES=10000 $(BUILD)/tests/unit/test_events
	FBD_EVENT_SCENES=4000 $(BUILD)/tests/unit/test_joined_events

# A million random impacts at one point, each held against its law, and a million at one to three; some two minutes.
impacts: $(BUILD)/.tests
	ninja -C $(BUILD) tests/unit/test_impact tests/unit/test_impacts
	FBD_IMPACTS=1000000 $(BUILD)/tests/unit/test_impact
	FBD_IMPACTS=1000000 $(BUILD)/tests/unit/test_impacts

# The tables of docs/error-bars.md; takes half an hour.
error-bars: $(BUILD)/.tests
	ninja -C $(BUILD)
	$(BUILD)/tests/bench/bench_error_bars models/*/*.yaml
	$(BUILD)/tests/bench/validate_error_bars models/*/*.yaml

# What others have published, against what fbd says: writes docs/verification.md and its line in README.md; some
# four minutes. SymPy is asked where it can be had (Debian's Python has it, others may not).
verify: $(BUILD)/.tests
	-.ci/install-packages verify
	ninja -C $(BUILD)
	$(or $(wildcard /usr/bin/python3),python3) tests/verify/verify.py $(BUILD)

# Data of thirty systems to 12 digits, and of a grid of inclined planes, for other engines (docs/reference-systems.md).
reference: all
	tests/reference/reference.py $(BUILD) $(BUILD)/reference

# Engines of Debian beside these data: writes the table of docs/reference-systems.md.
engines: all
	.ci/install-packages run engines
	[ -f $(BUILD)-engines/build.ninja ] || meson setup $(BUILD)-engines tests/reference/engines
	ninja -C $(BUILD)-engines
	tests/reference/engines.py $(BUILD) $(BUILD)-engines

# The table of error bars of random scenes that are rich in events (docs/error-bars.md); takes some minutes.
event-bars: $(BUILD)/.tests
	ninja -C $(BUILD) tests/bench/validate_event_bars
	$(BUILD)/tests/bench/validate_event_bars 400 21

# Short pulses and phases late in a run, 10,000 random scenes each, and a million switches.
late-times: $(BUILD)/.tests
	ninja -C $(BUILD) tests/unit/test_late_times
	FBD_LATE_SCENES=10000 FBD_MANY_SWITCHES=1000000 $(BUILD)/tests/unit/test_late_times

# What the default method costs beside the best one on each model, and whether less tolerance was ever worse.
methods: $(BUILD)/.tests
	ninja -C $(BUILD) tests/bench/bench_methods
	$(BUILD)/tests/bench/bench_methods models/*/*.yaml

# Whether ten times less tolerance is ever worse: every method on the gallery and on random scenes; takes some minutes.
TIGHTER = 100
tighter: $(BUILD)/.tests
	ninja -C $(BUILD) tests/cross/tighter
	$(BUILD)/tests/cross/tighter --all --scenes $(TIGHTER) models

# The implicit methods beside GSL's own; takes some minutes.
implicit: $(BUILD)/.tests
	ninja -C $(BUILD) tests/bench/bench_implicit
	$(BUILD)/tests/bench/bench_implicit models/*/*.yaml

# Every allocation and every call on a file of some seventy command lines fails in turn; takes some minutes. The
# tests do the same with fewer of them.
failures: $(BUILD)/.tests
	ninja -C $(BUILD)
	for kind in memory files; do \
		FBD_SOURCE_ROOT=$(CURDIR) FBD_BUILD_ROOT=$(CURDIR)/$(BUILD) $(BUILD)/tests/failures/fail_each $$kind \
			$(CURDIR)/$(BUILD)/tests/failures/libfailure-layer.so tests/failures/command_lines || exit; \
	done

check-format: $(BUILD)/.lint
	.ci/lint $(BUILD) format

format: $(BUILD)/.lint
	find lib apps tests examples -name '*.[ch]' -exec clang-format -i {} +

lint: $(BUILD)/.lint
	.ci/lint $(BUILD)

gallery: $(BUILD)/.tests
	ninja -C $(BUILD)
	docs/make-gallery $(BUILD)/apps/fbd-run

# FMUs beside what others have published: schemas, headers, FMPy (docs/fmi.md, Tests). Absent ones are skipped.
fmu-importer: all
	FBD_SOURCE_ROOT=$(CURDIR) FBD_BUILD_ROOT=$(CURDIR)/$(BUILD) FBD_RUN=$(CURDIR)/$(BUILD)/apps/fbd-run \
		/usr/bin/python3 tests/fmi/published.py

# The Python module with this build's library in it, in an environment of its own: build-python/bin/python.
python: all
	.ci/install-packages python
	/usr/bin/python3 -m venv --system-site-packages $(BUILD)-python
	PKG_CONFIG_PATH=$(CURDIR)/$(BUILD)/meson-uninstalled $(BUILD)-python/bin/pip install --no-build-isolation ./python

# What makes a page live (fbd-run --html page.html --live): the library for browsers, into build-live, where it stays;
# and fbd-run with it inside.
LIVE = build-live
live: $(BUILD)/build.ninja
	.ci/install-packages run live
	lib/live/module/make $(LIVE)
	meson configure $(BUILD) -Dlive=enabled -Dlive-files=$(CURDIR)/$(LIVE)
	ninja -C $(BUILD) programs

# Every model of the gallery live in Chromium, held against fbd-run; takes some minutes.
live-check: live $(BUILD)/.tests
	ninja -C $(BUILD)
	FBD_ALL_PAGES=1 FBD_TEST_TIMEOUT=10 .ci/test $(BUILD) --no-rebuild live

# The page of every model of the gallery in Chromium, of which the tests take a twelfth; some minutes.
pages: $(BUILD)/.tests
	ninja -C $(BUILD)
	FBD_ALL_PAGES=1 FBD_TEST_TIMEOUT=10 .ci/test $(BUILD) --no-rebuild page

# The pages by axe-core, from npm, which finds nothing in them; some minutes. After `make live` also in live pages and sheets to learn by.
axe: all
	.ci/install-packages axe
	npm install --silent --no-audit --no-fund --prefix $(BUILD)/axe axe-core@4.14.1
	FBD_SOURCE_ROOT=$(CURDIR) FBD_RUN=$(BUILD)/apps/fbd-run FBD_AXE=$(BUILD)/axe/node_modules/axe-core/axe.min.js tests/page/axe.py

# The same for other systems: one file with GSL and libyaml in it, build-wheel/fbd_mechanics-VERSION-....whl.
wheel: all
	.ci/install-packages run python
	packaging/wheel $(BUILD) $(BUILD)-wheel

# The Python module as source, with the library that it needs: build-sdist/fbd_mechanics-VERSION.tar.gz, of what is committed.
sdist:
	packaging/sdist $(BUILD)-sdist

# That pip builds it elsewhere, and that it runs a model; some minutes.
sdist-check: $(BUILD)/.tests
	FBD_SDIST=build .ci/test $(BUILD) --no-rebuild sdist

# The language server in Debian's neovim: diagnostics arrive, and fixes are applied.
lsp-check: python
	.ci/install-packages editor
	tests/editor/lsp_check $(BUILD)-python/bin

# A folder that can be served from anywhere: every model live, and these documents.
SITE = $(BUILD)/site
site: live
	.ci/install-packages site
	$(or $(wildcard /usr/bin/python3),python3) docs/make-site $(BUILD)/apps/fbd-run $(SITE)

install: all
	meson install -C $(BUILD) --no-rebuild
	cp $(BUILD)/meson-logs/install-log.txt $(BUILD)/installed.txt

# What the last `make install` from this folder has put there.
uninstall:
	cp $(BUILD)/installed.txt $(BUILD)/meson-logs/install-log.txt
	ninja -C $(BUILD) uninstall

# The source as a tarball, of what is committed, with the finished module of live pages: $(BUILD)/dist. The same commit
# gives the same bytes.
dist: live
	packaging/dist $(BUILD)/dist $(LIVE)/fbd-live.wasm

# The recipes of packaging for the address at which that tarball is published: $(BUILD)/recipes.
SOURCE_URL =
recipes: dist
	@[ -n "$(SOURCE_URL)" ] || { echo 'usage: make recipes SOURCE_URL=ADDRESS' >&2; exit 2; }
	packaging/recipes $(BUILD)/recipes $(BUILD)/dist/fbd-*.tar.xz $(SOURCE_URL)

# The recipes read by the parsers of Nix and Ruby too.
recipes-check: $(BUILD)/.tests
	.ci/install-packages recipes
	.ci/test $(BUILD) --no-rebuild recipes

# That the tarball builds by itself, installs and goes away again, and that its run enters no function of an effect that
# is not listed; some two minutes.
dist-check: $(BUILD)/.tests
	ninja -C $(BUILD)
	FBD_DIST=build .ci/test $(BUILD) --no-rebuild dist

# Packages for Debian, of what is committed; `deb-check` also asks lintian, installs them and tries them.
DEBS = $(BUILD)-debian
deb: live
	.ci/install-packages run deb
	tests/packaging/debian $(DEBS) build

deb-check: live
	.ci/install-packages run deb
	tests/packaging/debian $(DEBS)

clean:
	rm -rf $(BUILD) $(BUILD)-*

# Where Debian looks for libraries. Meson knows it from dpkg-dev alone, and would else take lib64.
LIBDIR = $(if $(wildcard /etc/debian_version),--libdir=lib/$(shell $(CC) -print-multiarch))

$(BUILD)/build.ninja:
	.ci/install-packages run
	meson setup $(BUILD) $(LIBDIR) $(MESON_OPTIONS)

# Clang, whose sanitizers cost less than those of gcc, and which warns of other things; by ccache where gcc is.
CLANG = $(if $(filter ccache,$(firstword $(CC))),ccache )clang

$(BUILD)-sanitize/build.ninja:
	.ci/install-packages run sanitize
	CC="$(CLANG)" meson setup $(BUILD)-sanitize -Db_sanitize=address,undefined -Db_lundef=false -Doptimization=1 \
		-Dc_args=-g1 $(MESON_OPTIONS)

$(BUILD)-tsan/build.ninja:
	.ci/install-packages run
	meson setup $(BUILD)-tsan -Db_sanitize=thread $(MESON_OPTIONS)

$(BUILD)-fuzz/build.ninja:
	.ci/install-packages run fuzz
	CC=clang meson setup $(BUILD)-fuzz -Dfuzz=true -Db_sanitize=address,undefined -Db_lundef=false \
		-Dmpi=disabled $(MESON_OPTIONS)

$(BUILD)-count/build.ninja:
	.ci/install-packages run fuzz
	CC=clang meson setup $(BUILD)-count -Dfuzz=true -Db_lundef=false -Dmpi=disabled $(MESON_OPTIONS)

# A build that was set up before cmocka was there has no tests yet.
%/.tests: | %/build.ninja
	.ci/install-packages run test
	meson configure $* -Dtests=enabled
	touch $@

%/.lint: | %/.tests
	.ci/install-packages run test lint
	touch $@

.PHONY: all run reference engines portability satellites mutants generators compare test sanitize tsan valgrind faults cross-check fuzz bench measurements effects instructions error-bars event-bars events late-times implicit tighter methods impacts failures gallery python wheel sdist sdist-check fmu-importer live live-check axe lsp-check site check-format format lint install uninstall dist dist-check recipes recipes-check pages deb deb-check clean
.SECONDARY:
