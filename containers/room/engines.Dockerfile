# What a room outgrows one process by, as Debian 12 has it and .ci/run tries it: Redis 7.0, Janus 1.1, coturn 4.6, HAProxy 2.6.
FROM debian:bookworm-slim
RUN apt-get update \
 && apt-get install -y --no-install-recommends redis-server janus coturn haproxy \
 && rm -rf /var/lib/apt/lists/*
COPY containers/room/janus /etc/room/janus
COPY containers/room/turnserver.conf containers/room/haproxy.cfg /etc/room/
