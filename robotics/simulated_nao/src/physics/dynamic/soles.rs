//! What the force-sensitive resistors feel: contacts of the soles, shared among four corners.

use kinematics::feet::FORCE_SENSITIVE_RESISTORS;
use rapier3d_f64::prelude::{ColliderHandle, PairContacts, PhysicsWorld};
use types::feet::Side;

use super::super::STEP;

/// Forces on the resistors front left, front right, rear left, rear right of a sole, in N.
pub(super) fn contact_forces(world: &PhysicsWorld, sole: ColliderHandle, side: Side) -> [f64; 4] {
    let mut forces = [0.0; 4];
    let collider = &world.colliders[sole];
    for pair in world.contact_pairs_with(sole) {
        let PairContacts::Rigid(contacts) = &pair.contacts else {
            continue;
        };
        let is_first = pair.collider1 == sole;
        for manifold in contacts.solver_manifolds() {
            // Resistors feel what presses across the sole.
            let up = collider.position().rotation.inverse() * manifold.data.normal;
            let across = up.z.abs();
            for point in &manifold.points {
                let place = if is_first {
                    point.local_p1
                } else {
                    point.local_p2
                };
                let place = collider
                    .position_wrt_parent()
                    .map_or(place, |to_foot| to_foot.transform_point(place));
                let force = point.data.impulse / STEP.as_secs_f64() * across;
                for (sum, share) in forces.iter_mut().zip(shares(side, place.x, place.y)) {
                    *sum += share * force;
                }
            }
        }
    }
    forces
}

/// How the resistors share a force at a place of the sole; the shares sum to 1.
fn shares(side: Side, x: f64, y: f64) -> [f64; 4] {
    let places = FORCE_SENSITIVE_RESISTORS.on(side);
    let along = |place: f64, from: f64, to: f64| ((place - from) / (to - from)).clamp(0.0, 1.0);
    let front = along(x, places[2][0], places[0][0]);
    let left = along(y, places[1][1], places[0][1]);
    [
        front * left,
        front * (1.0 - left),
        (1.0 - front) * left,
        (1.0 - front) * (1.0 - left),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resistor_feels_what_presses_on_it() {
        for side in [Side::Left, Side::Right] {
            let [x, y] = FORCE_SENSITIVE_RESISTORS.on(side)[0];
            assert_eq!(shares(side, x, y), [1.0, 0.0, 0.0, 0.0]);
            assert_eq!(shares(side, -0.05, -0.05), [0.0, 0.0, 0.0, 1.0]);
            let sum: f64 = shares(side, 0.01, 0.013).iter().sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
    }
}
