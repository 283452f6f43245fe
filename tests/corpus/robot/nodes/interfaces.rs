use framework::{Result, Timestamp};

pub trait EyeInterface {
    fn read_image(&self, camera: usize) -> Result<(Timestamp, Vec<u8>)>;
}

pub trait BodyInterface {
    fn read_joints(&self) -> Result<(Timestamp, [f32; 3])>;
    fn write_joints(&self, joints: &[f32; 3]) -> Result<()>;
}
