//! The cases of `rename_all`, with the results that serde has.

/// How words of a name are joined.
#[derive(Clone, Copy)]
pub(super) enum Case {
    Camel,
    Kebab,
    Lower,
    Pascal,
    ScreamingKebab,
    ScreamingSnake,
    Snake,
    Upper,
}

impl Case {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "camelCase" => Self::Camel,
            "kebab-case" => Self::Kebab,
            "lowercase" => Self::Lower,
            "PascalCase" => Self::Pascal,
            "SCREAMING-KEBAB-CASE" => Self::ScreamingKebab,
            "SCREAMING_SNAKE_CASE" => Self::ScreamingSnake,
            "snake_case" => Self::Snake,
            "UPPERCASE" => Self::Upper,
            _ => return None,
        })
    }

    /// From snake_case.
    pub(super) fn field(self, name: &str) -> String {
        match self {
            Self::Camel => lower_first(&pascal(name)),
            Self::Kebab => name.replace('_', "-"),
            Self::Lower | Self::Snake => name.to_owned(),
            Self::Pascal => pascal(name),
            Self::ScreamingKebab => name.to_ascii_uppercase().replace('_', "-"),
            Self::ScreamingSnake | Self::Upper => name.to_ascii_uppercase(),
        }
    }

    /// From PascalCase.
    pub(super) fn variant(self, name: &str) -> String {
        match self {
            Self::Camel => lower_first(name),
            Self::Kebab => snake(name).replace('_', "-"),
            Self::Lower => name.to_ascii_lowercase(),
            Self::Pascal => name.to_owned(),
            Self::ScreamingKebab => snake(name).to_ascii_uppercase().replace('_', "-"),
            Self::ScreamingSnake => snake(name).to_ascii_uppercase(),
            Self::Snake => snake(name),
            Self::Upper => name.to_ascii_uppercase(),
        }
    }
}

fn pascal(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let mut characters = word.chars();
        let first = characters.next().map(|first| first.to_ascii_uppercase());
        first.into_iter().chain(characters).collect::<String>()
    });
    words.collect()
}

fn lower_first(name: &str) -> String {
    let mut characters = name.chars();
    let first = characters.next().map(|first| first.to_ascii_lowercase());
    first.into_iter().chain(characters).collect()
}

fn snake(name: &str) -> String {
    let mut snake = String::new();
    for (position, character) in name.char_indices() {
        if position > 0 && character.is_uppercase() {
            snake.push('_');
        }
        snake.push(character.to_ascii_lowercase());
    }
    snake
}

#[cfg(test)]
mod tests {
    use super::Case;

    #[test]
    fn names_are_joined_as_serde_joins_them() {
        for (case, field, variant) in [
            ("camelCase", "lampRadius2", "walkFast"),
            ("kebab-case", "lamp-radius2", "walk-fast"),
            ("lowercase", "lamp_radius2", "walkfast"),
            ("PascalCase", "LampRadius2", "WalkFast"),
            ("SCREAMING-KEBAB-CASE", "LAMP-RADIUS2", "WALK-FAST"),
            ("SCREAMING_SNAKE_CASE", "LAMP_RADIUS2", "WALK_FAST"),
            ("snake_case", "lamp_radius2", "walk_fast"),
            ("UPPERCASE", "LAMP_RADIUS2", "WALKFAST"),
        ] {
            let found = Case::from_name(case).expect(case);
            assert_eq!(found.field("lamp_radius2"), field, "{case}");
            assert_eq!(found.variant("WalkFast"), variant, "{case}");
        }
        assert!(Case::from_name("Camel_Case").is_none());
    }
}
