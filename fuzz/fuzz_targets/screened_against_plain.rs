#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::screened_against_plain`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::screened_against_plain(data));
