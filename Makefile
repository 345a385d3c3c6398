# `make` builds build/polylab, `make demo` labels a CAD model, `make test` runs the tests, `make help` names the rest.

# Library sources src/NAME.cpp in the order of their dependence; src/main.cpp is the program.
MODULES = costs orientation mesh align text io tet_surface maxflow alpha_expansion initial_labeling labeling_graph \
          turning_points patch polycube json statistics explain diff state paths validity_operators quality_operators routines \
          polish search polylab stages exports report picture cli mesh_stats dropin heap
TESTS = $(filter-out tests/test_rays.cpp,$(wildcard tests/*.cpp))

# To choose on the command line: config=release|debug|sanitize|coverage  werror=1  EMBREE=1  builddir=DIR  verbose=1  CXX=…  CXXFLAGS=…
config = release
builddir = build
PREFIX = /usr/local
SECONDS = 15
demo_model = golden/cases/bracket/bracket.mesh

flags_release = -O2 -g
flags_debug = -O0 -g -D_GLIBCXX_ASSERTIONS
flags_sanitize = -O1 -g -D_GLIBCXX_ASSERTIONS -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all
flags_fuzz = $(flags_sanitize) -fsanitize=fuzzer-no-link
flags_coverage = -O0 -g --coverage
$(if $(flags_$(config)),,$(error config=$(config): expected release, debug, sanitize or coverage))

# -ffp-contract=off: the same bits with and without fused multiply-add. No -DNDEBUG: cheap checks stay on.
warnings = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $(if $(werror),-Werror)
compile = $(CXX) -Iinclude $(warnings) $(flags_$(config)) $(CPPFLAGS) $(CXXFLAGS) -std=c++17 -ffp-contract=off
link = $(CXX) $(flags_$(config)) $(CXXFLAGS) $(LDFLAGS)

out = $(if $(filter release,$(config)),$(builddir),$(builddir)/$(config))
objects = $(builddir)/$(config)/objects
program = $(out)/polylab
library = $(out)/libpolylab.a
tests = $(out)/tests
library_objects = $(MODULES:%=$(objects)/src/%.o)
test_objects = $(TESTS:%.cpp=$(objects)/%.o)
sources = $(wildcard include/polylab/*.h src/*.cpp src/*.h tests/*.cpp tests/*.h)

absolute = $(if $(filter /%,$(1)),$(1),$(CURDIR)/$(1))
test_defines = -DPOLYLAB_SOURCE_DIR='"$(CURDIR)"' -DPOLYLAB_BUILD_DIR='"$(call absolute,$(out))"' \
               -DPOLYLAB_PROGRAM='"$(call absolute,$(program))"'
commit_of_tree = test -e .git && git rev-parse --short HEAD && (git diff --quiet HEAD || echo -dirty)
commit := $(subst $() ,,$(or $(shell ($(commit_of_tree)) 2>/dev/null),unknown))

say = @echo '  $@'
quiet = $(if $(verbose),,@)
dry_run = $(findstring n,$(firstword -$(MAKEFLAGS)))

MAKEFLAGS += --no-builtin-rules
.DELETE_ON_ERROR:
.PHONY: all demo test rays skip-rays fuzz golden golden-update remarks bench tie-audit doctest static amalgamated coverage install format format-fix tidy clean help FORCE

all: $(program)

# Linked statically where that works: half of a short run is the loading of shared libraries.
static_if_possible = $(if $(filter release,$(config)),$(shell echo 'int main() {}' | $(CXX) -static -x c++ - -o /dev/null 2>/dev/null && echo -static))
$(program): $(objects)/src/main.o $(library)
	$(say)
	$(quiet)$(link) $(static_if_possible) -o $@ $^

# Made anew, so that an object that left the list leaves the archive.
$(library): $(library_objects)
	$(say)
	@rm -f $@
	$(quiet)$(AR) rcs $@ $^

$(objects)/src/main.o: private defines = -DPOLYLAB_COMMIT='"$(commit)"'
$(objects)/src/main.o: $(objects)/commit
$(objects)/tests/%.o: private defines = $(test_defines)
$(test_objects) $(objects)/tests/test_rays.o: | doctest
$(objects)/%.o: %.cpp $(objects)/flags
	@mkdir -p $(@D)
	$(say)
	$(quiet)$(compile) $(defines) -MMD -MP -c -o $@ $<

# Files that are written only when their content changes, so that objects are rebuilt for new flags or a new commit.
stamp = @mkdir -p $(@D); test "$$(cat $@ 2>/dev/null)" = '$(subst ','\'',$(1))' || printf '%s\n' '$(subst ','\'',$(1))' > $@
$(objects)/flags: FORCE
	$(call stamp,$(compile) $(test_defines))
$(objects)/commit: FORCE
	$(call stamp,$(commit))

-include $(library_objects:.o=.d) $(test_objects:.o=.d) $(objects)/tools/bench.d $(objects)/tools/subdivide.d $(objects)/tests/fuzz/driver.d $(objects)/src/main.d

demo: $(program)
	@mkdir -p $(out)/demo
	$(program) label $(demo_model) -o $(out)/demo/labels.txt --stats $(out)/demo/stats.json --verbose

test: $(tests) $(program) $(if $(EMBREE),rays)
	@$(tests)

$(tests): $(test_objects) $(library)
	$(say)
	$(quiet)$(link) -o $@ $^

# Rays as an oracle, where Embree 3 is installed; POLYLAB_CORPUS=DIR adds surfaces of your own.
have_embree = $(shell echo '\#include <embree3/rtcore.h>' | $(CXX) $(CPPFLAGS) -E -x c++ - >/dev/null 2>&1 && echo yes)
rays: $(if $(have_embree),$(out)/rays,skip-rays)
	$(if $(have_embree),@$(out)/rays)
skip-rays:
	@echo "  skipped: $$(grep -c ^TEST_CASE tests/test_rays.cpp) tests with rays, since embree3/rtcore.h is not here; type: sudo apt-get install libembree-dev"
$(out)/rays: $(objects)/tests/test_rays.o $(objects)/tests/main.o $(objects)/tests/shapes.o $(library)
	$(say)
	$(quiet)$(link) -o $@ $^ -lembree3

doctest:
	@$(if $(or $(dry_run),$(shell tools/get_doctest.sh $(CXX) $(CPPFLAGS) && echo found)),:,$(error tests need the header doctest/doctest.h; type: sudo apt-get install doctest-dev))

# libFuzzer on each target of tests/fuzz_targets.cpp, for SECONDS each, from the seeds and what it found before. For a million
# runs of the pipeline: SECONDS=3600 builddir=build/long CXXFLAGS="-O2 -fno-sanitize=address -fno-sanitize-coverage=trace-cmp".
fuzz_targets = $(notdir $(wildcard tests/fuzz/seeds/*))
.PHONY: $(fuzz_targets:%=fuzz-%)
fuzz:
	@$(MAKE) --no-print-directory config=fuzz CXX=clang++ $(fuzz_targets:%=fuzz-%)
$(fuzz_targets:%=fuzz-%): fuzz-%: $(builddir)/fuzz/fuzz
	@mkdir -p $(builddir)/fuzz/$*
	@$< $* -max_total_time=$(SECONDS) -entropic=0 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix=$(builddir)/fuzz/$*- \
	    $(builddir)/fuzz/$* tests/fuzz/seeds/$* >$(builddir)/fuzz/$*.log 2>&1 || { tail -n 50 $(builddir)/fuzz/$*.log; exit 1; }
	@echo "  fuzz $*: $$(sed -n 's/stat::number_of_executed_units: *//p' $(builddir)/fuzz/$*.log) inputs"
$(builddir)/fuzz/fuzz: $(objects)/tests/fuzz/driver.o $(objects)/tests/fuzz_targets.o $(objects)/tests/shapes.o $(library)
	$(say)
	$(quiet)$(link) -fsanitize=fuzzer -o $@ $^

# The conformance kit; update rewrites named cases and ends with an error, so that it can't pass for a test.
golden: $(program)
	@tools/golden.sh compare $(program)
golden-update: $(program)
	@tools/golden.sh update $(program) $(CASE)

# By how much the comparisons that decide labels are decided, over all golden cases.
tie-audit:
	@mkdir -p $(out)
	$(quiet)$(compile) -DPOLYLAB_TIE_AUDIT -o $(out)/tie_audit tools/tie_audit.cpp $(MODULES:%=src/%.cpp) $(LDFLAGS)
	@$(out)/tie_audit golden/cases/*/*.obj golden/cases/*/*.mesh

# Where the time goes, per model and stage; tools/bench.sh has the variables CORPUS, GROWTH, BASE, REPEATS, CSV.
bench: $(out)/bench $(out)/subdivide
	@tools/bench.sh $^
$(out)/bench $(out)/subdivide: $(out)/%: $(objects)/tools/%.o $(library)
	$(say)
	$(quiet)$(link) $(static_if_possible) -o $@ $^

# What a port has to know: rules between equals, traps, and where the paper or the published code is left.
remarks:
	@grep -rnE 'tie:|port:|differs:' include src

static: $(builddir)/polylab-static
$(builddir)/polylab-static: $(objects)/src/main.o $(library)
	$(say)
	$(quiet)$(link) -static -o $@ $^

# All sources as one translation unit: proves that no two files use a name for different things.
amalgamated: $(out)/polylab-amalgamated
	$< --version
$(out)/polylab-amalgamated: $(out)/amalgamated.cpp $(wildcard include/polylab/*.h src/*.h src/*.cpp) $(objects)/flags $(objects)/commit
	$(say)
	$(quiet)$(compile) -I. -DPOLYLAB_COMMIT='"$(commit)"' $(LDFLAGS) -o $@ $<
$(out)/amalgamated.cpp: Makefile
	@mkdir -p $(@D)
	@printf '#include "%s"\n' $(MODULES:%=src/%.cpp) src/main.cpp > $@

coverage:
	@$(MAKE) --no-print-directory config=coverage test
	@tools/coverage.sh $(builddir)/coverage/objects/src

# The commands of src/dropin.cpp are links to the program; the tools find it from where they are.
dropins = $(shell sed -n 's/^    {"\([A-Za-z_]*\)",.*/\1/p' src/dropin.cpp)
install: $(program)
	install -d "$(DESTDIR)$(PREFIX)/bin" "$(DESTDIR)$(PREFIX)/lib" "$(DESTDIR)$(PREFIX)/include/polylab" \
	    "$(DESTDIR)$(PREFIX)/libexec/polylab" "$(DESTDIR)$(PREFIX)/share/polylab"
	install -m 755 $(program) "$(DESTDIR)$(PREFIX)/bin"
	install -m 644 $(library) "$(DESTDIR)$(PREFIX)/lib"
	install -m 644 include/polylab/*.h "$(DESTDIR)$(PREFIX)/include/polylab"
	for name in $(dropins); do ln -sf ../../bin/polylab "$(DESTDIR)$(PREFIX)/libexec/polylab/$$name" || exit 1; done
	install -m 755 tools/cad2labels tools/dataset "$(DESTDIR)$(PREFIX)/share/polylab"
	install -m 644 tools/dataset.smk tools/dataset_steps.py "$(DESTDIR)$(PREFIX)/share/polylab"
	for name in cad2labels dataset; do ln -sf ../share/polylab/$$name "$(DESTDIR)$(PREFIX)/bin/polylab-$$name" || exit 1; done

format:
	@clang-format --dry-run -Werror $(sources)
format-fix:
	@clang-format -i $(sources)

tidy: $(MODULES:%=tidy-%) tidy-main
tidy-%:
	@echo '  $@'
	@clang-tidy --quiet src/$*.cpp -- -std=c++17 -Iinclude

clean:
	rm -rf $(builddir)

help:
	@echo "make              build/polylab and build/libpolylab.a"
	@echo "make demo         labels the CAD model $(demo_model)"
	@echo "make test         builds and runs the tests (doctest)"
	@echo "make rays         holds orientation, convexity and labels against rays, where Embree 3 is; so does make test EMBREE=1"
	@echo "make fuzz         libFuzzer on every reader, on labelings and on the whole method, SECONDS=$(SECONDS) each (clang++)"
	@echo "make golden       compares with the golden cases; golden-update CASE=... rewrites some"
	@echo "make tie-audit    by how much the comparisons that decide labels are decided"
	@echo "make bench        times per stage; CORPUS=DIR, GROWTH=FILE, BASE=other/bench: see tools/bench.sh"
	@echo "make remarks      lists the rules between equals, traps for ports, and differences from the paper"
	@echo "make static       build/polylab-static, one file that runs anywhere"
	@echo "make amalgamated  all sources as one translation unit"
	@echo "make coverage     which share of the lines the tests run"
	@echo "make install      program, tools, headers and library to PREFIX ($(PREFIX)), under DESTDIR if set"
	@echo "make format       checks the format (clang-format 14); format-fix repairs it"
	@echo "make tidy         checks names and suspicious code (clang-tidy)"
	@echo "make clean        removes $(builddir)/"
	@echo "With: config=release|debug|sanitize|coverage  werror=1  builddir=DIR  verbose=1  CXX=...  CXXFLAGS=..."
