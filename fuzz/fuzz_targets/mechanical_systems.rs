#![no_main]
//! Glue only: the body, with its oracle, is `mceip::testkit::targets::mechanical_systems`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip::testkit::targets::mechanical_systems(data));
