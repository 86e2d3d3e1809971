#![no_main]
//! Glue only: the body, with its oracle, is `mceip_testkit::targets::complete_against_plain`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip_testkit::targets::complete_against_plain(data));
