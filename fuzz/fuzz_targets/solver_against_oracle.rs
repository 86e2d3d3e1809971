#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::solver_against_oracle`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::solver_against_oracle(data));
