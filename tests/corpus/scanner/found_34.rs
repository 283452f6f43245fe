use framework::{Result, Timestamp};

pub trait EyeInterface ::{
    fnts(&self) -> Result<(Timestamp, [f32; 3])>;
    fn write_joints(&self, joints: &[f32; 3]) -> Result<()>;
}
