//! What a line for a shell calls, as far as pages write such lines.

/// The arguments of every call of hulkgen in a block for a shell, `hulkgen` first.
pub(crate) fn calls(block: &str) -> Vec<Vec<String>> {
    let commands = block.lines().flat_map(commands);
    commands.filter_map(|words| call(&words)).collect()
}

/// Every other command of such a block, without the variables before it.
pub(crate) fn others(block: &str) -> Vec<Vec<String>> {
    let commands = block.lines().flat_map(commands);
    let others = commands.filter(|words| call(words).is_none());
    let others = others.map(|words| words[variables(&words)..].to_vec());
    others.filter(|words| !words.is_empty()).collect()
}

/// The commands of a line: what stands between `&&`, `|` and `;`, without comment and redirection.
fn commands(line: &str) -> Vec<Vec<String>> {
    let mut commands = vec![Vec::new()];
    for word in words(line) {
        let last = commands.last_mut().expect("there is always one");
        match word.as_str() {
            "&&" | "|" | ";" | "||" => commands.push(Vec::new()),
            _ => last.push(word),
        }
    }
    for command in &mut commands {
        let redirection = command.iter().position(|word| word == ">");
        command.truncate(redirection.unwrap_or(command.len()));
    }
    commands
}

/// Words of a line with their quotes taken away; a `#` at the begin of a word begins a comment.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for one in line.chars() {
        match (quote, one) {
            (Some(open), _) if open == one => quote = None,
            (Some(_), _) => word.get_or_insert_default().push(one),
            (None, '\'' | '"') => {
                quote = Some(one);
                word.get_or_insert_default();
            }
            (None, '#') if word.is_none() => break,
            (None, ' ') => words.extend(word.take()),
            (None, _) => word.get_or_insert_default().push(one),
        }
    }
    words.extend(word);
    words
}

/// Options of `cargo run` that name another program than hulkgen, or another workspace.
const OF_ANOTHER_PROGRAM: [&str; 3] = ["--bin", "--example", "--manifest-path"];

/// The arguments of hulkgen, called by its name or by cargo in this workspace.
fn call(words: &[String]) -> Option<Vec<String>> {
    let (program, arguments) = words[variables(words)..].split_first()?;
    let arguments = match program.as_str() {
        "hulkgen" => arguments,
        path if path.ends_with("/hulkgen") => arguments,
        "cargo" if arguments.first().is_some_and(|word| word == "run") => {
            let (own, arguments) =
                arguments.split_at(arguments.iter().position(|word| word == "--")?);
            let is_other = own
                .iter()
                .any(|word| OF_ANOTHER_PROGRAM.contains(&word.as_str()));
            if is_other {
                return None;
            }
            &arguments[1..]
        }
        _ => return None,
    };
    let program = std::iter::once("hulkgen".to_owned());
    Some(program.chain(arguments.iter().cloned()).collect())
}

/// How many words before the program set variables.
fn variables(words: &[String]) -> usize {
    let is_assignment =
        |word: &&String| word.split_once('=').is_some_and(|(name, _)| is_name(name));
    words.iter().take_while(is_assignment).count()
}

fn is_name(text: &str) -> bool {
    !text.is_empty()
        && text
            .chars()
            .all(|one| one.is_ascii_uppercase() || matches!(one, '_' | '0'..='9'))
}
