//! Values in the schemas that Foxglove and other tools draw without being told how.
//!
//! A type says that it is an image, transforms, joints or a log message by naming what makes it one:
//! `#[reflect(foxglove = Self::to_raw_image)]`, a function of the value and the time. Recordings use it in channels of outputs.
//! Names and fields are those of <https://github.com/foxglove/foxglove-sdk/tree/main/schemas/jsonschema>.

use std::fmt::Write as _;

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::time::Timestamp;

/// The well-known form of a type.
pub struct Form<T: ?Sized> {
    pub schema: FormSchema,
    /// Of a value and the time of its cycle; `None`: it has none now.
    pub write: fn(&T, Timestamp) -> Option<Value>,
}

/// What a form looks like.
#[derive(Clone, Copy, Debug)]
pub struct FormSchema {
    /// As Foxglove calls it.
    pub name: &'static str,
    /// JSON schema, draft-07.
    pub json: fn() -> Value,
}

/// One of the messages below.
pub trait Message: Serialize {
    const SCHEMA: FormSchema;
}

/// An image, row by row from the top.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RawImage {
    pub timestamp: Time,
    /// Of the camera: x right, y down, z forward.
    pub frame_id: String,
    /// In pixels.
    pub width: u32,
    pub height: u32,
    /// `rgb8`, `bgr8`, `mono8`, `yuyv`, …
    pub encoding: &'static str,
    /// Bytes of a row.
    pub step: u32,
    pub data: Base64,
}

/// An image as a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CompressedImage {
    pub timestamp: Time,
    pub frame_id: String,
    pub data: Base64,
    /// `jpeg`, `png`, `webp`.
    pub format: &'static str,
}

/// Where frames are in other frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameTransforms {
    pub transforms: Vec<FrameTransform>,
}

/// Where a frame is in another one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FrameTransform {
    pub timestamp: Time,
    pub parent_frame_id: String,
    pub child_frame_id: String,
    /// In metres.
    pub translation: Vector3,
    pub rotation: Quaternion,
}

/// What joints do.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct JointStates {
    pub timestamp: Time,
    pub joints: Vec<JointState>,
}

/// What a joint does, as far as that is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct JointState {
    pub name: String,
    /// In radians or metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
    /// In newton metres or newtons.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effort: Option<f64>,
}

/// A message of a log.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Log {
    pub timestamp: Time,
    /// 1 debug, 2 info, 3 warning, 4 error, 5 fatal.
    pub level: u8,
    pub message: String,
    /// Who says it.
    pub name: String,
    pub file: String,
    pub line: u32,
}

/// A time of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Time {
    pub sec: u32,
    pub nsec: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Vector3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quaternion {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub w: f64,
}

/// Bytes that are text in JSON (RFC 4648).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Base64(pub Vec<u8>);

impl Default for Quaternion {
    fn default() -> Self {
        Self {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: 1.0,
        }
    }
}

impl From<Timestamp> for Time {
    fn from(timestamp: Timestamp) -> Self {
        let (seconds, rest) = (
            timestamp.as_nanos() / 1_000_000_000,
            timestamp.as_nanos() % 1_000_000_000,
        );
        Self {
            // A run of 136 years.
            sec: u32::try_from(seconds).unwrap_or(u32::MAX),
            nsec: rest as u32,
        }
    }
}

impl Serialize for Base64 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        const LETTERS: &[u8; 64] =
            b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut text = String::with_capacity(self.0.len().div_ceil(3) * 4);
        for bytes in self.0.chunks(3) {
            let byte = |place: usize| u32::from(bytes.get(place).copied().unwrap_or_default());
            let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
            for place in 0..4 {
                let letter = LETTERS[(bits >> (18 - 6 * place)) as usize & 63];
                text.push(if place <= bytes.len() {
                    letter.into()
                } else {
                    '='
                });
            }
        }
        serializer.serialize_str(&text)
    }
}

/// The schema of what a function makes; for the derive.
pub fn schema_of<T: ?Sized, M: Message>(_: fn(&T, Timestamp) -> M) -> FormSchema {
    M::SCHEMA
}

/// A message as JSON; for the derive.
pub fn written(message: &impl Message) -> Option<Value> {
    serde_json::to_value(message).ok()
}

fn object(title: &str, properties: Value) -> Value {
    json!({ "title": title, "type": "object", "properties": properties })
}

fn root(title: &str, properties: Value) -> Value {
    let mut schema = object(title, properties);
    schema["$schema"] = "http://json-schema.org/draft-07/schema#".into();
    schema
}

fn time() -> Value {
    object(
        "time",
        json!({
            "sec": {"type": "integer", "minimum": 0},
            "nsec": {"type": "integer", "minimum": 0, "maximum": 999_999_999},
        }),
    )
}

fn numbers(title: &str, names: &str) -> Value {
    let number = |name: char| (name.to_string(), json!({"type": "number"}));
    object(title, names.chars().map(number).collect())
}

fn text() -> Value {
    json!({"type": "string"})
}

fn count() -> Value {
    json!({"type": "integer", "minimum": 0})
}

fn bytes() -> Value {
    json!({"type": "string", "contentEncoding": "base64"})
}

impl Message for RawImage {
    const SCHEMA: FormSchema = FormSchema {
        name: "foxglove.RawImage",
        json: || {
            root(
                "foxglove.RawImage",
                json!({
                    "timestamp": time(), "frame_id": text(), "width": count(), "height": count(),
                    "encoding": text(), "step": count(), "data": bytes(),
                }),
            )
        },
    };
}

impl Message for CompressedImage {
    const SCHEMA: FormSchema = FormSchema {
        name: "foxglove.CompressedImage",
        json: || {
            let properties = json!({
                "timestamp": time(), "frame_id": text(), "data": bytes(), "format": text(),
            });
            root("foxglove.CompressedImage", properties)
        },
    };
}

impl Message for FrameTransforms {
    const SCHEMA: FormSchema = FormSchema {
        name: "foxglove.FrameTransforms",
        json: || {
            let transform = object(
                "foxglove.FrameTransform",
                json!({
                    "timestamp": time(), "parent_frame_id": text(), "child_frame_id": text(),
                    "translation": numbers("foxglove.Vector3", "xyz"),
                    "rotation": numbers("foxglove.Quaternion", "xyzw"),
                }),
            );
            let transforms = json!({"type": "array", "items": transform});
            root(
                "foxglove.FrameTransforms",
                json!({ "transforms": transforms }),
            )
        },
    };
}

impl Message for JointStates {
    const SCHEMA: FormSchema = FormSchema {
        name: "foxglove.JointStates",
        json: || {
            let number = || json!({"type": "number"});
            let joint = object(
                "foxglove.JointState",
                json!({
                    "name": text(), "position": number(), "velocity": number(),
                    "acceleration": number(), "effort": number(),
                }),
            );
            let joints = json!({"type": "array", "items": joint});
            root(
                "foxglove.JointStates",
                json!({ "timestamp": time(), "joints": joints }),
            )
        },
    };
}

impl Message for Log {
    const SCHEMA: FormSchema = FormSchema {
        name: "foxglove.Log",
        json: || {
            root(
                "foxglove.Log",
                json!({
                    "timestamp": time(),
                    "level": {"type": "integer", "minimum": 0, "maximum": 5},
                    "message": text(), "name": text(), "file": text(), "line": count(),
                }),
            )
        },
    };
}

impl<T: ?Sized> std::fmt::Debug for Form<T> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_char('<')?;
        formatter.write_str(self.schema.name)?;
        formatter.write_char('>')
    }
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};
    use serde_json::json;

    use super::{Base64, JointState, JointStates};
    use crate::Reflect;
    use crate::time::Timestamp;

    /// One joint.
    #[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
    #[reflect(foxglove = Self::to_joint_states)]
    struct Knee {
        angle: f64,
    }

    impl Knee {
        fn to_joint_states(&self, timestamp: Timestamp) -> JointStates {
            JointStates {
                timestamp: timestamp.into(),
                joints: vec![JointState {
                    name: "knee".to_owned(),
                    position: Some(self.angle),
                    ..JointState::default()
                }],
            }
        }
    }

    #[test]
    fn a_type_says_what_it_is() {
        let form = <Option<Knee> as Reflect>::foxglove().expect("its type says so");
        assert_eq!(form.schema.name, "foxglove.JointStates");
        let time = Timestamp::from_nanos(2_500_000_000);
        assert_eq!(
            (form.write)(&Some(Knee { angle: 0.5 }), time),
            Some(json!({
                "timestamp": {"sec": 2, "nsec": 500_000_000},
                "joints": [{"name": "knee", "position": 0.5}],
            }))
        );
        assert_eq!((form.write)(&None, time), None);
        assert!(<u32 as Reflect>::foxglove().is_none());
    }

    #[test]
    fn bytes_are_text_in_json() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let written = serde_json::to_value(Base64(bytes.into())).expect("a text");
            assert_eq!(written, text);
        }
    }
}
