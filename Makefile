# Verbs: run test build bench bench-against paper percolation compression reproducibility docs test-asan fuzz
# polyhedra test-slurm test-debian12 test-debian13 package test-packages lint format packages clean. On Debian 12 and 13 each verb
# first installs the packages that it needs and that are missing.
#   make lint LINT='engine/solve/jam.cpp'
#   make run BUILD=/tmp/isojam/build OUTPUT=/tmp/isojam/results     # from a source folder that cannot be written
BUILD ?= build
OUTPUT ?= results
JOBS ?= $(shell nproc)
OPTIONS ?=
# The system's Python, since the packages of the tests belong to it; without it, the first on PATH.
PYTHON ?= $(firstword $(wildcard /usr/bin/python3) python3)
# Seconds after which a test counts as hanging.
TIMEOUT ?= 1200
EXAMPLE ?= examples/01-four-solids
# The folder of the example's results has the name that its manifest states.
RESULTS  = $(OUTPUT)/$(shell sed -n 's/.*"name": *"\([^"]*\)".*/\1/p' $(EXAMPLE)/manifest.json)

# ---- Packages, one list per need ----------------------------------------------------------------------------
PROGRAM_PACKAGES := build-essential cmake ninja-build git libtbb-dev libeigen3-dev libspectra-dev libmetis-dev \
                    nlohmann-json3-dev libfmt-dev libcli11-dev libboost-dev libjs-vega libjs-three
LINT_PACKAGES    := clang-format clang-tidy
LIBCXX_PACKAGES  := clang-19 libc++-19-dev libc++abi-19-dev
TEST_PACKAGES    := $(PROGRAM_PACKAGES) libgtest-dev libvalijson-dev python3 python3-ase python3-gsd python3-vtk9 \
                    python3-numpy python3-pandas python3-matplotlib python3-scipy python3-yaml groff-base zsh fish
# Where there is no browser its tests say that they are skipped; everything else is tested.
BROWSER_PACKAGES := chromium chromium-driver fonts-dejavu-core python3-selenium mkdocs
# Debian 12 has clang 14, Debian 13 has clang 19.
CLANG            ?= $(shell . /etc/os-release 2>/dev/null; [ "$$VERSION_ID" = 12 ] && echo 14 || echo 19)
CLANG_PACKAGES   := clang-$(CLANG)
FUZZ_PACKAGES    := $(PROGRAM_PACKAGES) $(CLANG_PACKAGES) libclang-rt-$(CLANG)-dev llvm-$(CLANG)
BENCH_PACKAGES   := $(TEST_PACKAGES) libbenchmark-dev voro++-dev libsuitesparse-dev libopenblas-serial-dev yade
PACKAGE_PACKAGES := dpkg-dev python3-build python3-setuptools python3-wheel
SLURM_PACKAGES   := slurm-wlm munge python3
DOCS_PACKAGES    := mkdocs doxygen python3

# $(call install,packages): the network is touched only if one of them is missing.
define install
	@command -v dpkg-query >/dev/null || { echo 'This is not Debian: nothing is installed. docs/install.md has the names of the packages.' >&2; exit 0; }; \
	missing=; \
	for package in $(1); do \
	  dpkg-query -W -f '$${db:Status-Status}\n' $$package 2>/dev/null | grep -qx installed || missing="$$missing $$package"; \
	done; \
	[ -n "$$missing" ] || exit 0; \
	if [ "$$(id -u)" = 0 ]; then as_root=; \
	elif command -v sudo >/dev/null; then as_root=sudo; \
	else \
	  echo 'Packages are missing, and make needs root or sudo to install them. As root, run:' >&2; \
	  echo "  apt-get update && apt-get install --no-install-recommends$$missing" >&2; \
	  exit 1; \
	fi; \
	echo "installing:$$missing" >&2; \
	{ $$as_root apt-get -q update && \
	  $$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends $$missing </dev/null; } || { \
	  echo 'The packages could not be installed. Check the network and /etc/apt/sources.list; the reason stands above.' >&2; \
	  exit 1; \
	}
endef

# ---- Building ------------------------------------------------------------------------------------------------
CONFIGURE = cmake -S . -B $(BUILD) -G Ninja -DISOJAM_NATIVE=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON $(OPTIONS)
# A fresh directory does without the tests and their packages; one that has them keeps them, so that going back
# and forth between `make run` and `make test` compiles nothing twice.
CONFIGURE_PROGRAM = $(CONFIGURE) $(if $(wildcard $(BUILD)/CMakeCache.txt),,-DISOJAM_TESTS=OFF)

.PHONY: build run test test-asan fuzz test-slurm bench paper percolation compression docs lint format clean
.DEFAULT_GOAL := build

# Names other folders where the source folder cannot be written.
define check_writable
	@mkdir -p $(BUILD) $(OUTPUT) 2>/dev/null && [ -w $(BUILD) ] && [ -w $(OUTPUT) ] || { \
	  echo 'The folders $(BUILD) and $(OUTPUT) cannot be written. Choose others:' >&2; \
	  echo '  make $@ BUILD=/tmp/isojam/build OUTPUT=/tmp/isojam/results' >&2; exit 1; }
endef

build:
	$(check_writable)
	$(call install,$(PROGRAM_PACKAGES))
	$(CONFIGURE_PROGRAM)
	cmake --build $(BUILD) -j $(JOBS) --target isojam

run: build
	$(BUILD)/isojam run $(EXAMPLE)/manifest.json -o $(RESULTS)
	@$(BUILD)/isojam report $(RESULTS)

# The studies of examples/paper, examples/rigidity and examples/percolation; then the page, its tables and its figures
# from their results. An interrupted call is resumed. A replicate that failed (exit 1) is counted on the page.
PAPER = n100 n400 n400-tetrahedra n4000 unstable emergence
CONSTRAINTS = constraints constraints-tetrahedra line line-dense line-cohesion line-cycles
RIGIDITY = n50 n64 n200 solids
PERCOLATION = kept100 removed100 tetrahedra kept200 removed200 cycles range cubes kept400 tetrahedra400
# Measures that an interrupted call left come first, because `run` would compute the whole replicate again.
studies = @for study in $(1); do \
	  [ ! -d results/$(2)-$${study\#n}/records ] || $(BUILD)/isojam measure results/$(2)-$${study\#n} >/dev/null || [ $$? = 1 ] || exit 1; \
	  $(BUILD)/isojam run examples/$(2)/$$study.json >/dev/null || [ $$? = 1 ] || exit 1; \
	done
# Measures that take long, only of the states nearest jamming: of all states, if a manifest has them.
nearest = @$(BUILD)/isojam measure results/$(1) --add $(2) >/dev/null || [ $$? = 1 ]
comma := ,
GATHER = $(PYTHON) -B examples/page/gather.py $(BUILD)/isojam results
page = @$(PYTHON) -B examples/$(1)/figures.py results/$(1) $(2) && \
	  $(PYTHON) -B examples/$(1)/page.py --data $(2) -o results/$(1)
# Both pages need the studies of both.
paper: build
	$(call install,python3 python3-matplotlib python3-scipy)
	$(call studies,$(PAPER),paper)
	$(call studies,$(RIGIDITY) $(CONSTRAINTS),rigidity)
	$(call nearest,paper-400,backbone)
	$(call nearest,paper-400-tetrahedra,backbone$(comma)rigidity)
	$(call nearest,paper-4000,rigidity)
	$(call nearest,paper-unstable,difference_modes)
	@$(GATHER) results/paper/records.json $(addprefix paper-,$(PAPER:n%=%))
	@$(GATHER) results/rigidity/records.json $(addprefix rigidity-,$(RIGIDITY:n%=%))
	@$(GATHER) results/rigidity/constraints.json $(addprefix rigidity-,$(CONSTRAINTS))
	$(call page,paper,$(addprefix results/,paper/records.json rigidity/constraints.json))
	$(call page,rigidity,$(addprefix results/,paper/records.json rigidity/records.json rigidity/constraints.json))
	@$(PYTHON) -B examples/page/verdict.py results/rigidity/constraints.json

percolation: build
	$(call install,python3 python3-matplotlib python3-scipy)
	$(call studies,$(PERCOLATION),percolation)
	@$(PYTHON) -B examples/percolation/gather.py $(BUILD)/isojam results results/percolation/records.json $(addprefix percolation-,$(PERCOLATION))
	$(call page,percolation,results/percolation/records.json)

compression: build
	$(call install,python3 python3-matplotlib python3-pandas python3-scipy)
	$(call studies,compression compression-tetrahedra compression-start,02-strain-step)
	@for study in results/02-strain-step-compression*/; do \
	  $(BUILD)/isojam --quiet export $$study all --format replicates -o $${study%/}.csv || exit 1; \
	done
	@$(PYTHON) -B examples/02-strain-step/compression.py results/02-strain-step-compression*.csv

# A cross build for arm64. Its libraries are Debian's packages, unpacked in a folder: nothing of them is installed.
ARM64 = $(abspath $(BUILD)-arm64)
ON_ARM64 = qemu-aarch64 -L $(ARM64)/root
FOR_ARM64 = -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
            -DCMAKE_SYSROOT=$(ARM64)/root '-DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64;-L;$(ARM64)/root' \
            $(foreach kind,LIBRARY INCLUDE PACKAGE,-DCMAKE_FIND_ROOT_PATH_MODE_$(kind)=ONLY) \
            -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER
ONLY_STUDIES = -DISOJAM_TESTS=OFF -DISOJAM_EXTRAS=OFF
APT_ARM64 = apt-get -q -y -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Install-Recommends=false \
            -o APT::Sandbox::User=root -o Dir::State=$@.apt -o Dir::State::status=/dev/null -o Dir::Cache=$@.apt
$(ARM64)/root:
	$(call install,g++-aarch64-linux-gnu qemu-user)
	mkdir -p $@.apt/archives/partial $@.part
	$(APT_ARM64) update
	$(APT_ARM64) install --download-only g++ libgtest-dev $(filter lib% nlohmann%,$(PROGRAM_PACKAGES))
	for package in $@.apt/archives/*.deb; do dpkg -x $$package $@.part || exit 1; done
	rm -rf $@.apt && mv $@.part $@

# All that `run` and `test` install, and nothing else: for the layer of an image.
.PHONY: packages
packages:
	$(call install,$(TEST_PACKAGES) $(BROWSER_PACKAGES))

.PHONY: browser
browser:
	$(call install,$(BROWSER_PACKAGES))

test:
	$(check_writable)
	$(call install,$(TEST_PACKAGES))
	@$(MAKE) --no-print-directory browser || echo 'NO BROWSER COULD BE INSTALLED: the report is not tested in one' >&2
	$(CONFIGURE) -DISOJAM_TESTS=ON
	cmake --build $(BUILD) -j $(JOBS)
	ctest --test-dir $(BUILD) -j $(JOBS) --output-on-failure --no-tests=error --timeout $(TIMEOUT)

# The pages, the fields of files and a reference of the engine's headers, as a site. A link that leads nowhere is an error,
# and so is a public declaration without a comment.
docs: build
	$(call install,$(DOCS_PACKAGES))
	@rm -rf $(BUILD)/docs && mkdir -p $(BUILD)/docs/source
	$(PYTHON) -B docs/site/gather.py . $(BUILD)/docs $(BUILD)/isojam
	PUBLIC_HEADERS="$$(sed -n '/FILE_SET HEADERS BASE/,/)$$/s|^  \(.*\.hpp\).*|engine/\1|p' engine/CMakeLists.txt | tr '\n' ' ')" \
	  PYTHON=$(PYTHON) DOCS_BUILD=$(BUILD)/docs doxygen docs/site/Doxyfile
	mkdocs build --quiet --strict -f $(BUILD)/docs/mkdocs.yml
	@echo '$(BUILD)/docs/site/index.html'

# The files in schemas/, from the descriptions of the program.
.PHONY: schemas extending
schemas: build
	@for name in $(SCHEMAS); do $(BUILD)/isojam schema $$name -o schemas/$$name.schema.json || exit 1; done
SCHEMAS = manifest record packing path tables chart chart_data

# The diffs of docs/developing.md, in a copy of the sources.
extending:
	$(call install,$(PROGRAM_PACKAGES) python3 python3-numpy python3-pandas)
	$(PYTHON) -B tests/docs/extending.py . $(BUILD)-extending

# The same bytes from g++ and clang, with AVX2 and for every x86-64 processor, from arm64 and, as root, from Debian 13. An
# emulator runs arm64, with tests of arithmetic, overlaps and factorisations, and those of arithmetic without FMA.
REPRODUCIBLE = tests/reproducibility
FACTOR_TESTS = *Cholesky*:DefiniteSolver*:FactorThreads*-*FailedPivot*:*NewFactor*
.PHONY: reproducibility
reproducibility: build $(ARM64)/root
	$(call install,$(PROGRAM_PACKAGES) $(CLANG_PACKAGES) libgtest-dev python3)
	cmake -S . -B $(BUILD)-clang -G Ninja -DCMAKE_CXX_COMPILER=clang++-$(CLANG) -DISOJAM_NATIVE=ON $(ONLY_STUDIES)
	cmake -S . -B $(BUILD)-clang-portable -G Ninja -DCMAKE_CXX_COMPILER=clang++-$(CLANG) -DISOJAM_NATIVE=OFF $(ONLY_STUDIES)
	cmake -S . -B $(BUILD)-portable -G Ninja -DISOJAM_NATIVE=OFF -DISOJAM_TESTS=ON -DISOJAM_EXTRAS=OFF
	cmake -S . -B $(ARM64) -G Ninja $(FOR_ARM64) -DISOJAM_TESTS=ON -DISOJAM_EXTRAS=OFF
	for folder in $(BUILD)-clang $(BUILD)-clang-portable $(BUILD)-portable $(ARM64); do \
	  cmake --build $$folder -j $(JOBS) --target isojam || exit 1; done
	cmake --build $(BUILD)-portable -j $(JOBS) --target elementary_tests
	qemu-x86_64 -cpu Nehalem $(BUILD)-portable/tests/engine/arithmetic/elementary_tests --gtest_brief=1
	cmake --build $(ARM64) -j $(JOBS) --target elementary_tests geometry_tests solve_tests
	for tests in arithmetic/elementary_tests geometry/geometry_tests 'solve/solve_tests --gtest_filter=$(FACTOR_TESTS)'; do \
	  $(ON_ARM64) $(ARM64)/tests/engine/$$tests --gtest_brief=1 || exit 1; done
	@[ "$$(id -u)" = 0 ] || echo 'Without root rights the build of Debian 13 is left out.' >&2
	@[ "$$(id -u)" != 0 ] || $(MAKE) --no-print-directory $(TRIXIE)/isojam/build/isojam
	$(PYTHON) -B $(REPRODUCIBLE)/same_bytes.py $(REPRODUCIBLE)/manifest.json $(REPRODUCIBLE)/quick.json g++=$(BUILD)/isojam \
	  'g++-without-fma-in-libm=env GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 $(BUILD)/isojam' \
	  clang=$(BUILD)-clang/isojam g++-portable=$(BUILD)-portable/isojam clang-portable=$(BUILD)-clang-portable/isojam \
	  $(if $(filter 0,$(shell id -u)),'debian13=$(TRIXIE)/lib64/ld-linux-x86-64.so.2 --library-path \
	  $(TRIXIE)/lib/x86_64-linux-gnu $(TRIXIE)/isojam/build/isojam') \
	  'arm64=$(ON_ARM64) $(ARM64)/isojam'

TRIXIE = $(abspath $(BUILD)-trixie)
$(TRIXIE)/isojam/build/isojam:
	$(call install,debootstrap)
	tests/debian/root.sh make $(TRIXIE) trixie
	tests/debian/root.sh clone $(TRIXIE) .
	tests/debian/root.sh run $(TRIXIE) make build OPTIONS=-DISOJAM_EXTRAS=OFF

# Both commands of the README in a clean root of a Debian release: as root, with a fresh clone of this commit. The root is
# removed at the end.
.PHONY: test-debian12 test-debian13
test-debian12: SUITE = bookworm
test-debian13: SUITE = trixie
test-debian12 test-debian13:
	$(call install,debootstrap)
	tests/debian/root.sh make $(BUILD)-$(SUITE) $(SUITE)
	tests/debian/root.sh clone $(BUILD)-$(SUITE) .
	tests/debian/root.sh run $(BUILD)-$(SUITE) make run
	tests/debian/root.sh run $(BUILD)-$(SUITE) make test
	tests/debian/root.sh remove $(BUILD)-$(SUITE)

# Packages of HEAD, in $(BUILD)-package. They are built from its source archive, so that what is not committed is not in
# them, and from nothing, since an archive of an older commit has older files.
VERSION  = $(shell sed -n 's/^project.isojam VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
ARCHIVE  = isojam-$(VERSION)
PACKAGES = $(BUILD)-package
PACKAGE  = cmake -S $(PACKAGES)/$(ARCHIVE) -G Ninja -DISOJAM_PACKAGE=ON -DISOJAM_TESTS=OFF \
           -DISOJAM_PYTHON_DIR=lib/python3/dist-packages $(OPTIONS)
.PHONY: package
package: $(ARM64)/root
	$(call install,$(PROGRAM_PACKAGES) $(PACKAGE_PACKAGES))
	rm -rf $(PACKAGES) && mkdir -p $(PACKAGES)/wheel
	git archive --prefix=$(ARCHIVE)/ HEAD | gzip -9n >$(PACKAGES)/$(ARCHIVE).tar.gz
	cd $(PACKAGES) && sha256sum $(ARCHIVE).tar.gz >$(ARCHIVE).tar.gz.sha256 && tar -xzf $(ARCHIVE).tar.gz
	$(PACKAGE) -B $(PACKAGES)/build
	$(PACKAGE) -B $(PACKAGES)/arm64 $(FOR_ARM64)
	for folder in build arm64; do \
	  cmake --build $(PACKAGES)/$$folder -j $(JOBS) && cpack --config $(PACKAGES)/$$folder/CPackConfig.cmake -B $(PACKAGES) || exit 1; \
	done
	cd $(PACKAGES)/$(ARCHIVE) && cp -r LICENSE docs/packaging/wheel/pyproject.toml tasks/extras/python/isojam ../wheel
	cp $(PACKAGES)/build/tasks/extras/python/installed/facts.json $(PACKAGES)/wheel/isojam
	$(PYTHON) -m build --wheel --no-isolation --outdir $(PACKAGES) $(PACKAGES)/wheel
	@ls -shd $(PACKAGES)/isojam[_-]*.*

# The packages in copies of clean roots, as root. ROOTS names roots that exist; the others are made.
ROOTS ?= $(BUILD)-bookworm $(BUILD)-trixie
.PHONY: test-packages
test-packages: $(ROOTS)
	$(call install,lintian)
	lintian --fail-on error $(PACKAGES)/*.deb
	tests/packages/test.sh $(PACKAGES) $(ROOTS)

$(BUILD)-bookworm $(BUILD)-trixie:
	$(call install,debootstrap)
	tests/debian/root.sh make $@ $(@:$(BUILD)-%=%)

# As root. Not a part of `test`: it starts daemons.
test-slurm: build
	$(call install,$(SLURM_PACKAGES))
	tests/slurm/test_slurm.sh $(BUILD)/isojam

bench:
	$(call install,$(BENCH_PACKAGES))
	$(CONFIGURE) -DISOJAM_TESTS=ON -DISOJAM_BENCH=ON
	cmake --build $(BUILD) -j $(JOBS) --target isojam_bench
	$(BUILD)/isojam_bench --benchmark_out=$(BUILD)/bench.json
	$(PYTHON) -B tests/bench/ratios.py $(BUILD)/bench.json $(BUILD)/ratios.json

# The benchmarks of FILTER of this tree and of that of the commit BEFORE, in turn: make bench-against BEFORE=HEAD~5
FILTER ?= .
.PHONY: bench-against
bench-against:
	@[ -n "$(BEFORE)" ] || { echo 'make bench-against BEFORE=COMMIT [FILTER=REGEX]' >&2; exit 2; }
	$(call install,$(BENCH_PACKAGES))
	$(CONFIGURE) -DISOJAM_TESTS=ON -DISOJAM_BENCH=ON
	cmake --build $(BUILD) -j $(JOBS) --target isojam_bench
	rm -rf $(BUILD)-before && mkdir -p $(BUILD)-before/tree
	git archive $(BEFORE) | tar -x -C $(BUILD)-before/tree
	cmake -S $(BUILD)-before/tree -B $(BUILD)-before -G Ninja -DISOJAM_NATIVE=ON -DISOJAM_TESTS=ON -DISOJAM_BENCH=ON
	cmake --build $(BUILD)-before -j $(JOBS) --target isojam_bench
	$(PYTHON) -B tests/bench/ratios.py --against $(BUILD)-before/isojam_bench $(BUILD)/isojam_bench --filter '$(FILTER)'

# The long tests of user-defined solids: 20 000 pairs against 50 digits, and packings of all 45 polyhedra.
.PHONY: polyhedra
polyhedra:
	$(call install,$(TEST_PACKAGES))
	$(CONFIGURE) -DISOJAM_TESTS=ON
	cmake --build $(BUILD) -j $(JOBS) --target isojam defined_pairs_tests
	ISOJAM_ORACLE_PAIRS=20500 $(BUILD)/tests/oracle/defined_pairs_tests
	$(PYTHON) -B tests/polyhedra/jam_test.py $(BUILD)/isojam --all

# The whole suite under the address and undefined-behaviour sanitizers, assertions on, in a directory of its own.
test-asan:
	$(MAKE) test BUILD=$(BUILD)-asan OPTIONS='-DISOJAM_SANITIZE=address,undefined -DISOJAM_ASSERT=ON $(OPTIONS)' TIMEOUT=9600

# Each fuzzer for FUZZ_SECONDS, from the seeds in tests/fuzz/seeds; what it found stays in $(BUILD)-fuzz.
FUZZ_SECONDS ?= 300
fuzz:
	$(call install,$(FUZZ_PACKAGES))
	cmake -S . -B $(BUILD)-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++-$(CLANG) -DISOJAM_TESTS=OFF -DISOJAM_FUZZ=ON \
	  -DISOJAM_NATIVE=ON -DISOJAM_SANITIZE=address,undefined -DISOJAM_ASSERT=ON $(OPTIONS)
	cmake --build $(BUILD)-fuzz -j $(JOBS) --target fuzzers
	bash tests/fuzz/run.sh $(BUILD)-fuzz $(FUZZ_SECONDS)

clean:
	rm -rf --one-file-system $(BUILD) $(BUILD)-asan $(BUILD)-clang $(BUILD)-clang-portable $(BUILD)-portable $(BUILD)-before \
	  $(BUILD)-package $(BUILD)-fuzz $(BUILD)-lint $(BUILD)-trixie $(BUILD)-bookworm $(ARM64)

# ---- Style ---------------------------------------------------------------------------------------------------
FILES   := $(shell find $(wildcard engine tasks tests) -name '*.cpp' -o -name '*.hpp' | sort)
# Not ?=, for make has a LINT of its own; the command line wins over := as well.
LINT    := $(filter %.cpp,$(FILES))
EIGEN   ?= /usr/include/eigen3
STAMPS   = $(LINT:%=$(BUILD)-lint/stamps/%)
CONFIGURE_LINT = $(subst -B $(BUILD),-B $(BUILD)-lint,$(CONFIGURE)) -DISOJAM_TESTS=ON -DISOJAM_BENCH=ON \
                 -DISOJAM_FUZZ=ON -DISOJAM_BATCHES=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON

# In a directory of its own, where nothing is built: clang-tidy cannot read the headers that g++ precompiles, and so sees
# that every source includes what it needs.
lint:
	$(call install,$(filter-out yade,$(BENCH_PACKAGES)) $(LINT_PACKAGES) $(LIBCXX_PACKAGES))
	@clang-format --dry-run -Werror $(FILES)
	$(CONFIGURE_LINT)
	@$(MAKE) --no-print-directory -j $(JOBS) -O -k lint-sources

.PHONY: lint-sources
lint-sources: $(STAMPS)

# The sources of the program also compile with another standard library. Boost 1.74 needs what C++17 removed.
LIBCXX = clang++-19 -stdlib=libc++ -fexperimental-library -std=c++20 -fsyntax-only -w -DEIGEN_DONT_VECTORIZE \
         $(foreach name,VERSION GIT_HASH COMPILER,-DISOJAM_$(name)=\"\") -D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION \
         -I. -I$(BUILD)-lint/generated -isystem $(EIGEN)
# A stamp says that this source passed, with the headers it includes and this configuration.
$(STAMPS): $(BUILD)-lint/stamps/%: % .clang-tidy tests/.clang-tidy
	@mkdir -p $(@D)
	@echo 'clang-tidy $<'
	@clang-tidy --quiet -p $(BUILD)-lint $< >$@.log 2>&1 || { grep -v ' warnings generated' $@.log; exit 1; }
	$(if $(filter engine/% tasks/%,$<),@$(LIBCXX) $<)
	@$(CXX) -std=c++20 -MM -MP -MT $@ -MF $@.d -I. -I$(BUILD)-lint/generated -isystem $(EIGEN) $<
	@touch $@

-include $(wildcard $(STAMPS:=.d))

format:
	$(call install,clang-format)
	@clang-format -i $(FILES)
