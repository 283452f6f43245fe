pub mod body;
pub mod eye;
pub mod interfaces;
pub mod legs;
pub mod node;
pub mod spots;
pub mod t@ypes;
[[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cy]][[cycler][cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]]impl BodyInterface for Hardware {}
impl EyeInterface for Hardware {}
