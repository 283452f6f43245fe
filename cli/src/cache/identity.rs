//! Which hulkgen this is: what another one answered may not be the answer of this one.

use std::fs;
use std::os::unix::fs::MetadataExt as _;

use crate::digest::Digest;

/// Of the file of the running program; `None` if there is none that can be asked.
///
/// Its bytes are more than everything else that is read for an answer. Who writes a program anew gives it another time of
/// status change, which nobody can set, unlike the time of its last change.
pub(super) fn of_this_program() -> Option<Digest> {
    // On Linux this is the program itself, whatever has taken its path meanwhile.
    let about = fs::metadata("/proc/self/exe")
        .or_else(|_| fs::metadata(std::env::current_exe()?))
        .ok()?;
    let numbers = [
        about.dev(),
        about.ino(),
        about.size(),
        about.mtime().cast_unsigned(),
        about.mtime_nsec().cast_unsigned(),
        about.ctime().cast_unsigned(),
        about.ctime_nsec().cast_unsigned(),
    ];
    let numbers = numbers.map(u64::to_le_bytes);
    let version = env!("CARGO_PKG_VERSION").as_bytes();
    let numbers = numbers.iter().map(<[u8; 8]>::as_slice);
    Some(Digest::of_parts(numbers.chain([version])))
}
