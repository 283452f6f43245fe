//! Owns the order of values in arrays that become named fields (Aldebaran documentation; for the
//! battery the order that robots send: status before current).

use types::sensor_data::{Battery, Touch};

pub(super) fn to_battery(values: [f32; 4]) -> Battery {
    let [charge, status, current, temperature] = values;
    Battery {
        charge,
        status,
        current,
        temperature,
    }
}

pub(super) fn from_battery(battery: &Battery) -> [f32; 4] {
    [
        battery.charge,
        battery.status,
        battery.current,
        battery.temperature,
    ]
}

pub(super) fn to_touch(values: [f32; 14]) -> Touch {
    let [
        chest_button,
        head_front,
        head_middle,
        head_rear,
        left_foot_left,
        left_foot_right,
        left_hand_back,
        left_hand_left,
        left_hand_right,
        right_foot_left,
        right_foot_right,
        right_hand_back,
        right_hand_left,
        right_hand_right,
    ] = values.map(|value| value > 0.5);
    Touch {
        chest_button,
        head_front,
        head_middle,
        head_rear,
        left_foot_left,
        left_foot_right,
        left_hand_back,
        left_hand_left,
        left_hand_right,
        right_foot_left,
        right_foot_right,
        right_hand_back,
        right_hand_left,
        right_hand_right,
    }
}

pub(super) fn from_touch(touch: &Touch) -> [f32; 14] {
    [
        touch.chest_button,
        touch.head_front,
        touch.head_middle,
        touch.head_rear,
        touch.left_foot_left,
        touch.left_foot_right,
        touch.left_hand_back,
        touch.left_hand_left,
        touch.left_hand_right,
        touch.right_foot_left,
        touch.right_foot_right,
        touch.right_hand_back,
        touch.right_hand_left,
        touch.right_hand_right,
    ]
    .map(|touched| if touched { 1.0 } else { 0.0 })
}
