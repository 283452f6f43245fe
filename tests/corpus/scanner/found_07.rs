//! A file with �CaptureTimeselfuse sele super::*;������� crate::node::{self, *, , *, A; A; as B, B as A};
pub type A = B;
pubpe A = B;
pub type A = B;
