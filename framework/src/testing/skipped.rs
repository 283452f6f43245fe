//! What a test says that cannot run where it is.

use std::env;
use std::io::{Write, stderr};

/// Makes a skipped test a failure, if it is `1`.
const REQUIRE_ALL: &str = "HULKGEN_REQUIRE_ALL";

/// Says that a test was skipped and what to do so that it is not; the test returns after it.
///
/// # Panics
/// Where everything is required: `HULKGEN_REQUIRE_ALL=1`.
pub fn skip(name: &str, what_to_install: &str) {
    // Past the test harness, which would keep it to itself. Without stderr there is nobody to tell.
    let _ = writeln!(stderr(), "SKIPPED {name}: {what_to_install}");
    let is_required = env::var(REQUIRE_ALL).is_ok_and(|value| value == "1");
    assert!(
        !is_required,
        "{name} must run where {REQUIRE_ALL}=1: {what_to_install}"
    );
}
