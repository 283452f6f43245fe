//! What the buttons, plates and bumpers report.

use framework::Timestamp;
use types::sensor_data::Touch;

use crate::settings::{Button, Press};

/// Everything that is pressed at a time.
pub(super) fn touch(presses: &[Press], now: Timestamp) -> Touch {
    let seconds = (now - Timestamp::ZERO).as_secs_f64();
    let mut touch = Touch::default();
    for press in presses.iter().filter(|press| press.is_down(seconds)) {
        match press.button {
            Button::Chest => touch.chest_button = true,
            Button::Head => {
                touch.head_front = true;
                touch.head_middle = true;
                touch.head_rear = true;
            }
            Button::LeftBumper => {
                touch.left_foot_left = true;
                touch.left_foot_right = true;
            }
            Button::RightBumper => {
                touch.right_foot_left = true;
                touch.right_foot_right = true;
            }
        }
    }
    touch
}

#[cfg(test)]
mod tests {
    use framework::testing::at_millis;

    use super::*;

    #[test]
    fn buttons_are_down_as_long_as_they_are_pressed() {
        let presses = [
            Press {
                at: 0.5,
                button: Button::Chest,
                lasts: 0.2,
            },
            Press {
                at: 0.6,
                button: Button::Head,
                lasts: 1.0,
            },
        ];
        let at = |millis| touch(&presses, at_millis(millis));
        assert_eq!(at(499), Touch::default());
        assert!(at(500).chest_button && !at(500).head_front);
        assert!(at(650).chest_button && at(650).head_front && at(650).head_rear);
        assert!(!at(700).chest_button && at(1599).head_middle);
        assert_eq!(at(1600), Touch::default());
    }
}
