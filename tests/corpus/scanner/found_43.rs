use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
#[derive(Clone, pub struct Spot {
    pub place: Point2<f32>,
    pub certain:body.rs}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub [[cycler]] {
    pub best: Option<Spot[,
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub [[cycler]] {
    pub best: Option<Spot[,
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub [[cycler]] {
    pub best: Option<Spot[,
    pub pose: Isometry3<f32>,
    pub counts: [u32; 4],
Input<
#[derive(Clone, Copy, Debug, Default, Deserialize, Reflect, Serialize)]
#serde(r">,[[cycler]]"spots.threshold">,
    limits: Parameter<[f64; 2], "spots.limits">,CycleConte CyclerState<u64, "seen">,
}

#[context]
pub struct MainOutputs {
    spots: MainOutput<Vec<Spot>>,
    best: MainOutput<Option<Spot>>,
    report: MainOutput<u64, "count">Input<u64, "count">Input<u64, , "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count{
        context.considered.fill_if_subscribed"count">Input, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">, "Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64 ,"count">Input<u64, "count">Input<u64, , "count">count">Input<u64, "count">Input�u64, "count">Input<u64, "count">Input<u64, "cunt">Inputount">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Inpuount">Inpuount">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u28, "count">Input<u64, "count">Input<countnt">Input<u64, "count">Input<u64, "count">Input<u64, "ncout">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count">Input<u64, "count����put<u64, "‮

 serde::{Deserialize,