use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use framework::{Clear, Reflect};
use [u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70][u8; 1 << 70]//! A file with �[u8; 1 << �70][u8;