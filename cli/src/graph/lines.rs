//! Writing line by line.

use std::fmt::{Arguments, Write as _};

pub(super) fn line(text: &mut String, arguments: Arguments<'_>) {
    writeln!(text, "{arguments}").expect("writing to a string cannot fail");
}
