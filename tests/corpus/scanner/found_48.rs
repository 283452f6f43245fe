Input, LatestInput, use std::;
use s:dp:tath::PathBuf;
use std:~~~~~~~~~~~~~~~~~~~~~~~}~~~~~~~~~~~~~~~~~KKKKKKKKKKKKKKKKKKKK~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~:nodes::eyetion;

use framew, Timestamp};

pub trait EyeInterfa.e {
 CyclerState<f32, "