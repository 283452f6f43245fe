//! No robot takes another one's tones for a whistle.

use serde::Deserialize;
use types::audio::Tone;

#[derive(Deserialize)]
struct Parameters {
    tone_selector: Tones,
    whistle_detection: Band,
}

#[derive(Deserialize)]
struct Tones {
    whistle_tone: Tone,
    state_tone: Tone,
}

#[derive(Deserialize)]
struct Band {
    lowest_frequency: f32,
    highest_frequency: f32,
}

#[test]
fn tones_and_their_loud_overtone_lie_outside_the_band_of_whistles() {
    let text = include_str!("../../parameters/default.toml");
    let Parameters {
        tone_selector,
        whistle_detection: band,
    } = toml::from_str(text).unwrap();
    for tone in [tone_selector.whistle_tone, tone_selector.state_tone] {
        for overtone in [1.0, 2.0] {
            let frequency = overtone * tone.frequency;
            assert!(
                frequency < band.lowest_frequency || frequency > band.highest_frequency,
                "{frequency} Hz"
            );
        }
        assert!(tone.duration <= 0.5 && (0.0..=1.0).contains(&tone.volume));
    }
}
