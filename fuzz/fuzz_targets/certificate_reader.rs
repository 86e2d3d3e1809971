#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::certificate_reader`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::certificate_reader(data));
