//! Search that proves: floats propose witnesses, exact arithmetic accepts them.

pub mod complete;
