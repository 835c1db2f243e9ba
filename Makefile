# Two commands do everything on Debian and Ubuntu, packages included: make demo, make test.
#   make demo        build, run the double cantilever beam, compare with the paper
#   make test        every test: release, sanitizers, fuzzers; all of them run, then those that failed are named
#   make test-long   what repeats tests of `make test` at greater length: more increments, more twins
#   make build       the program, build/bin/scabo; the Python package too if what it needs is installed
#   make python      the Python package, build/python
#   make report      the page that `scabo report` fills; brings Node.js and npm if there are none
#   make wheel       the same as a wheel, build/wheel
#   make fuzz        the fuzzers, FUZZ_SECONDS each
#   make random      random models and their twins from SEED on (1000), COUNT of them (100)
#   make bench       against CalculiX and GetFEM
#   make bench-contact   contact solvers against Siconos's; PROBLEMS=folder of .hdf5 files in FCLIB's layout
#   make bench-large   1e4 to 2e6 degrees of freedom, 32 to 3,000 contact pairs, cyclic loads, a thousand bodies; a quarter of an hour and 13 GB
#   make bench-sizes   Scabo, CalculiX and GetFEM at equal error, to 1e5 degrees of freedom of theirs; half an hour
#   make bench-kills   a run killed at 50 random moments and resumed: the same bits
#   make bench-elements  super-elements against the eigenvector route, one thread
#   make bench-python    the Python package against the program
#   make format      lay the sources out by .clang-format
#   make docs        the manual, build/docs/html/index.html
#   make packages    everything that apt can bring
#   make install     to PREFIX (/usr/local)
#   make package     a .deb in build/package
#   make clean       removes build/ and build-*/
# PYTHON=... names the interpreter (or SCABO_PYTHON in the environment), JOBS=... the number of parallel jobs.
# SCABO_PACKAGES=no installs no packages.
PYTHON = $(SCABO_PYTHON)
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 15
SEED ?= 1000
COUNT ?= 100

configure = cmake $(if $(PYTHON),-DSCABO_PYTHON="$(PYTHON)") --preset
# Node.js and npm for the page of reports, unless there are some from elsewhere.
report = $(shell command -v npm >/dev/null 2>&1 || echo report)
with_python = python=$$(cmake/find_python.sh "$(PYTHON)") && "$$python"

.PHONY: help demo build python report wheel test test-release test-asan test-long fuzz random bench bench-contact bench-large bench-sizes bench-kills bench-elements bench-python docs format packages install package clean
help:
	@sed -n 's/^#   //p' Makefile

demo:
	@cmake/install_packages.sh build
	@$(configure) release
	@cmake --build --preset release --target scabo_program --parallel $(JOBS)
	@$(with_python) examples/01_double_cantilever/compare.py --scabo build/bin/scabo

build:
	@cmake/install_packages.sh build
	@$(configure) release
	@cmake --build --preset release --target product --parallel $(JOBS)

python:
	@cmake/install_packages.sh build python $(report)
	@$(configure) release -DSCABO_PYTHON_MODULE=ON
	@cmake --build --preset release --target python_package --parallel $(JOBS)

report:
	@cmake/install_packages.sh build $(report)
	@$(configure) release -DSCABO_REPORT=ON
	@cmake --build --preset release --target scabo_program report_page --parallel $(JOBS)

wheel: python
	@cmake --build --preset release --target wheel

test:
	@cmake/install_packages.sh build test python $(report) mpi
	@MAKE="$(MAKE)" cmake/run_stages.sh "Release build and tests" test-release \
	  "Sanitizer build and tests" test-asan "Fuzzers" fuzz

test-release:
	@$(configure) release
	@cmake --build --preset release --parallel $(JOBS)
	@ctest --preset release --parallel $(JOBS)

test-asan:
	@$(configure) asan
	@cmake --build --preset asan --parallel $(JOBS)
	@ctest --preset asan --parallel $(JOBS)

test-long:
	@$(configure) release
	@cmake --build --preset release --parallel $(JOBS)
	@export SCABO_LONG=1 && ctest --preset release -L long --parallel $(JOBS)

fuzz:
	@$(configure) asan
	@cmake --build --preset asan --target fuzzers --parallel $(JOBS)
	@cmake/run_fuzzers.sh build-asan $(FUZZ_SECONDS)

random:
	@$(MAKE) --no-print-directory build
	@$(with_python) tests/random/run.py build/bin/scabo --from $(SEED) --count $(COUNT) --keep build/random.failed

bench:
	@cmake/install_packages.sh build bench
	@$(MAKE) --no-print-directory build
	@$(with_python) benchmarks/peers/run.py --scabo build/bin/scabo

bench-contact:
	@cmake/install_packages.sh build bench
	@$(MAKE) --no-print-directory build
	@/usr/bin/python3 benchmarks/contact/run.py $(PROBLEMS) --scabo build/bin/scabo --output build/bench-contact

bench-large:
	@cmake/install_packages.sh build bench
	@$(MAKE) --no-print-directory build
	@$(configure) release -DSCABO_BENCHMARKS=ON
	@cmake --build --preset release --target large_sparse --parallel $(JOBS)
	@/usr/bin/python3 benchmarks/large/run.py --scabo build/bin/scabo --sparse build/bin/large_sparse --most 2e6 --gigabytes 19 --output build/bench-large
	@/usr/bin/python3 benchmarks/plan.py --scabo build/bin/scabo --runs build/bench-large/runs.json
	@/usr/bin/python3 benchmarks/large/cycles.py --scabo build/bin/scabo
	@/usr/bin/python3 benchmarks/large/bodies.py --scabo build/bin/scabo

bench-sizes:
	@cmake/install_packages.sh build bench
	@$(MAKE) --no-print-directory build
	@$(with_python) benchmarks/peers/sizes.py --scabo build/bin/scabo

bench-kills:
	@$(MAKE) --no-print-directory build
	@export SCABO_KILLS=50 && $(with_python) tests/regression/resume_test.py build/bin/scabo Resume.test_killed_at_random_moments

bench-elements:
	@cmake/install_packages.sh build bench
	@$(configure) release -DSCABO_BENCHMARKS=ON
	@cmake --build --preset release --target super_elements --parallel $(JOBS)
	@OPENBLAS_NUM_THREADS=1 build/bin/super_elements

bench-python: python
	@$(MAKE) --no-print-directory build
	@export PYTHONPATH=build/python && $(with_python) benchmarks/python/run.py --scabo build/bin/scabo

docs: python
	@cmake/install_packages.sh docs
	@cmake --build --preset release --target product verification_programs --parallel $(JOBS)
	@/usr/bin/python3 docs/site/build.py --build build --output build/docs

format:
	@cmake/install_packages.sh format
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

packages:
	@cmake/install_packages.sh build test python $(report) cad mpi docs bench

install: build
	@cmake --install build --prefix "$(PREFIX)"

package:
	@cmake/install_packages.sh build package $(report)
	@$(MAKE) --no-print-directory build
	@cpack --config build/CPackConfig.cmake

clean:
	rm -rf build build-*
