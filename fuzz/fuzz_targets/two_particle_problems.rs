#![no_main]
//! Glue only: the body, with its oracle, is `mceip_testkit::targets::two_particle_problems`.
libfuzzer_sys::fuzz_target!(|data: &[u8]| mceip_testkit::targets::two_particle_problems(data));
