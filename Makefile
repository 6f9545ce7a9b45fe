# A thin front over apt and the CMake presets: each line can be typed by hand instead. `make help` lists the targets.
packages := g++ ccache mold cmake ninja-build pkg-config xz-utils libeigen3-dev libbullet-dev libbullet-extras-dev liburdfdom-dev libconsole-bridge-dev \
  libtinyxml2-dev libassimp-dev zlib1g-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libfmt-dev libegl1 libgl1-mesa-dri libopengl0 libegl-dev \
  libepoxy-dev libfreetype-dev libpng-dev fonts-dejavu-core ffmpeg libgtest-dev libgmock-dev libbenchmark-dev liborocos-kdl-dev help2man \
  pybind11-dev python3-dev python3-numpy $(if $(wildcard /usr/bin/gnuplot),,gnuplot-nox)
tools := clang-format clang-tidy
testing := chromium doxygen dpkg-dev file libmujoco-dev python3-pytest python3-matplotlib python3-pandas mypy
documenting := doxygen
measuring := valgrind
fuzzing := clang libclang-rt-dev
sources = $(shell find plugin scenes bench tests -name '*.[ch]pp')
.PHONY: help bench python test debug asan tsan fuzz format tidy micro docs meshes page readme clean
.PRECIOUS: build/%/build.ninja
help:                                  ## this list
	@sed -nE 's/^([a-z]+( [a-z]+)*): .*## /\1:\t/p' Makefile | expand -t 20
bench: build/release/build.ninja       ## build, run every scene with every method, print the comparison, fill results/
	cmake --build --preset release --target seam && build/release/bench/seam bench --out results
python: build/release/build.ninja      ## build the module of Python, for PYTHONPATH=build/release/python
	cmake --build --preset release --target seam_python_package && echo 'export PYTHONPATH=$(CURDIR)/build/release/python'
test: build/testing build/release/build.ninja ## build and run every test
	cmake --build --preset release && ctest --preset release
debug asan tsan: %: build/testing build/%/build.ninja ## build and run every test with assertions; address and UB, or thread, sanitizer
	cmake --build --preset $@ && ctest --preset $@
fuzz: build/fuzzing build/fuzz/build.ninja ## feed the readers with nonsense (libFuzzer), each for SECONDS (600)
	cmake --build --preset fuzz && sh tests/fuzz/run.sh build/fuzz $(or $(SECONDS),600)
format: build/tools ; @clang-format $(if $(FIX),-i,--dry-run -Werror) $(sources) ## check the layout of the C++ sources (FIX=1: put it right)
tidy: build/tools build/release/build.ninja ; run-clang-tidy -quiet -p build/release '/(plugin|scenes|bench|tests)/.*\.cpp$$' ## check the C++ sources
micro: build/measuring build/release/build.ninja ## measure the hot paths, each beside something bare, and print their ratios
	cmake --build --preset release --target seam_micro seam_touched seam_micro_python && build/release/bench/seam_micro --out build/micro.md
	sh bench/micro/touched.sh build/release/bench/seam_touched >>build/micro.md && tail -n 1 build/micro.md
	PYTHONPATH=build/release/python:build/release/bench /usr/bin/python3 bench/micro/python.py --append build/micro.md
docs: build/documenting ; @sh plugin/guide/reference.sh build/docs ## make the reference and the guide: build/docs/html/index.html
meshes page:                           ## make the arm's meshes, or the report page's template, anew (needs Node.js)
	cd $(if $(filter page,$@),bench/page,assets/pa10/source) && npm ci && npm run $@
readme: bench micro ; bash bench/readme.sh ## put the figures of bench, micro and experiments into the READMEs
clean: ; rm -rf build results          ## remove what was built
build/packages build/tools build/testing build/documenting build/measuring build/fuzzing: Makefile
	@sh .ci/install-packages.sh $@.log $($(@F)) && mkdir -p build && touch $@
build/setup: build/packages ; @sh plugin/cmake/bullet-headers.sh build/bullet-headers && touch $@
build/%/build.ninja: build/setup CMakePresets.json ; cmake --preset $* && touch $@
