#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::exact_against_naive`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::exact_against_naive(data));
