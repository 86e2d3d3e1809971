#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::hostile_report`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::hostile_report(data));
