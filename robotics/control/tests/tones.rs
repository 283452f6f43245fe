//! No robot takes another one's tones for a whistle.

use framework::testing::ParameterFile;
use types::audio::Tone;

#[test]
fn tones_and_their_loud_overtone_lie_outside_the_band_of_whistles() {
    let parameters = ParameterFile::new(include_str!("../../parameters/default.toml"));
    let lowest: f32 = parameters.get("whistle_detection.lowest_frequency");
    let highest: f32 = parameters.get("whistle_detection.highest_frequency");
    for path in ["tone_selector.whistle_tone", "tone_selector.state_tone"] {
        let tone: Tone = parameters.get(path);
        for overtone in [1.0, 2.0] {
            let frequency = overtone * tone.frequency;
            assert!(frequency < lowest || frequency > highest, "{frequency} Hz");
        }
        assert!(tone.duration <= 0.5 && (0.0..=1.0).contains(&tone.volume));
    }
}
