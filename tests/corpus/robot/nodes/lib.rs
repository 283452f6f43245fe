pub mod body;
pub mod eye;
pub mod interfaces;
pub mod legs;
pub mod node;
pub mod spots;
pub mod types;

use interfaces::{BodyInterface, EyeInterface};

pub struct Hardware;

impl framework::Hardware for Hardware {}
impl BodyInterface for Hardware {}
impl EyeInterface for Hardware {}
