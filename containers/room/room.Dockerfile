# One server of rooms. Build from the repository, after `make room-face` if faces shall be seen:
#
#     docker build -f containers/room/room.Dockerfile -t room .
#
# It was written where no container can be built: the commands are those of .ci/run and of tests/room, which are tried.
FROM python:3.11-slim-bookworm

WORKDIR /opt/room
COPY pyproject.toml constraints.txt README.md LICENSE NOTICE ./
COPY facegen facegen
COPY regress regress
COPY track track
COPY room room
RUN pip install --no-cache-dir --constraint constraints.txt '.[redis]'

# keys and recordings belong to nobody else
RUN useradd --create-home room && mkdir /keys && chown room /keys
USER room
VOLUME /keys
ENV PYTHONUNBUFFERED=1
EXPOSE 8443
HEALTHCHECK --interval=5s CMD ["python", "-c", "import ssl, urllib.request; urllib.request.urlopen('https://127.0.0.1:8443/health', context=ssl._create_unverified_context(), timeout=3)"]
# exec form: a stop must reach the server itself, which tells everybody
ENTRYPOINT ["room"]
CMD ["--help"]
