//! Nodes of cycler `Lidar`: from a scan to where there is room.

pub mod freeway_detection;
pub mod scan_receiver;
