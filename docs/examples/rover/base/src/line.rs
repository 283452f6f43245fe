//! The lines between the rover and its controller, UTF-8, each ended by a line feed. SI units; the rover's frame is that of
//! the nodes: x forward, y left, angles counter-clockwise.
//!
//! | From | Line | Meaning |
//! |---|---|---|
//! | controller | `wheels LEFT RIGHT` | metres that each wheel rolled since the line before, 50 a second |
//! | controller | `scan RANGE …` | metres from the lidar, all around from straight ahead, counter-clockwise; `inf` where nothing is, 10 a second |
//! | rover | `drive FORWARD TURN` | the speeds to reach, m/s and rad/s |
//! | rover | `stop` | nobody commands: brake |
//!
//! The controller brakes by itself when nothing came for 200 ms: a rover that hangs, or is unplugged, must not drive on.

use rover_nodes::types::Rolled;

/// Bytes of a line with its end; a scan of [`MOST_RAYS`] has fewer.
pub(crate) const LONGEST: usize = 8192;

/// Rays of a turn.
const MOST_RAYS: usize = 720;

/// No wheel of a rover rolls farther between two lines, m; half a second at the motors' best.
const FARTHEST: f32 = 0.5;

/// The rover brakes.
pub(crate) const STOP: &str = "stop\n";

/// What the controller says.
#[derive(Debug, PartialEq)]
pub(crate) enum Line {
    Wheels(Rolled),
    Scan(Vec<f32>),
}

/// The line that asks for these speeds.
pub(crate) fn drive(forward: f32, turn: f32) -> String {
    format!("drive {forward} {turn}\n")
}

/// What a line says; `None`: no controller says that.
pub(crate) fn read(line: &[u8]) -> Option<Line> {
    let mut words = str::from_utf8(line).ok()?.split_ascii_whitespace();
    let name = words.next()?;
    // More words than any line has need not be read.
    let numbers = words.by_ref().take(MOST_RAYS).map(|word| word.parse().ok());
    let numbers: Vec<f32> = numbers.collect::<Option<_>>()?;
    if words.next().is_some() {
        return None;
    }
    match (name, numbers.as_slice()) {
        // What is no number is not inside.
        ("wheels", [left, right]) => {
            let is_possible = |rolled: &f32| rolled.abs() <= FARTHEST;
            let rolled = Rolled {
                left: *left,
                right: *right,
            };
            (is_possible(left) && is_possible(right)).then_some(Line::Wheels(rolled))
        }
        // With fewer there would be a direction into which nobody looked.
        ("scan", ranges) if ranges.len() >= 4 => {
            let are_ranges = ranges.iter().all(|range| *range >= 0.0);
            are_ranges.then_some(Line::Scan(numbers))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_controller_are_read() {
        let rolled = Rolled {
            left: 0.01,
            right: -0.02,
        };
        assert_eq!(read(b"wheels 0.01 -2e-2\r\n"), Some(Line::Wheels(rolled)));
        let ranges = vec![1.0, 2.5, f32::INFINITY, 0.0];
        assert_eq!(read(b"scan 1 2.5 inf 0\n"), Some(Line::Scan(ranges)));
        assert_eq!(drive(0.5, -1.0), "drive 0.5 -1\n");
    }

    #[test]
    fn nothing_else_is_believed() {
        let long = format!("scan{}", " 1".repeat(MOST_RAYS + 1));
        for line in [
            &b""[..],
            b"\n",
            b"wheels",
            b"wheels 1",
            b"wheels 0.1 0.1 0.1",
            b"wheels nan 0",
            b"wheels inf 0",
            b"wheels 0 0.6",
            b"wheels a b",
            b"scan",
            b"scan 1 1 1",
            b"scan 1 1 1 -1",
            b"scan 1 1 1 nan",
            b"drive 1 1",
            b"\xff\xfe 1 1",
            b"wheels 0.1\x000.1",
            long.as_bytes(),
        ] {
            assert_eq!(read(line), None, "{:?}", String::from_utf8_lossy(line));
        }
    }
}
