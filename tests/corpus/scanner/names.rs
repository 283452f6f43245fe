//! A file with ﻿ and 🤖.
use self::*;
use super::*;
pub use crate::node::{self, *, A as B, B as A};
pub type A = B;
