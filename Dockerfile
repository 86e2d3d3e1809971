# The program without a Rust toolchain:
#
#     docker build -t mceip .
#     docker run --rm -v "$PWD:/work" mceip analyze problem.json
#
# Files are read and written in /work, the folder that is mounted.
FROM rust:1.95-slim-bookworm AS build
WORKDIR /mceip
COPY . .
RUN cargo build --release --locked --bin mceip

FROM debian:bookworm-slim
COPY --from=build /mceip/target/release/mceip /usr/local/bin/mceip
COPY --from=build /mceip/LICENSE-APACHE /mceip/LICENSE-MIT /usr/share/doc/mceip/
WORKDIR /work
ENTRYPOINT ["mceip"]
