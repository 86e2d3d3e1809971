#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::checker_against_forgeries`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::checker_against_forgeries(data));
