//! What the oracle reads of a file, by its own few lines on syn: fields of contexts, functions of nodes, types.
//!
//! Invariant: nothing here is hulkgen's, so that a mistake of hulkgen's scanner is not made twice.

use std::collections::BTreeMap;
use std::ops::Range;

use syn::spanned::Spanned;
use syn::token::Brace;
use syn::{
    Block, Expr, Fields, FnArg, GenericArgument, ImplItem, Item, Lit, PathArguments, ReturnType,
    Signature, Type,
};

/// The three structs of a node, in this order.
pub(crate) const CONTEXTS: [&str; 3] = ["CreationContext", "CycleContext", "MainOutputs"];

/// A Rust file as the oracle sees it.
#[derive(Clone, Debug, Default)]
pub(crate) struct File {
    /// Fields of the three structs.
    pub(crate) fields: Vec<Field>,
    /// Bytes of the closing brace of each context.
    pub(crate) ends: BTreeMap<&'static str, usize>,
    /// Every struct with named fields, and every enum.
    pub(crate) types: BTreeMap<String, Definition>,
    /// `new`, `cycle` and `restore` of the type that has the first two; empty if there is none.
    pub(crate) functions: Vec<Function>,
    /// Lines on which a node's absence may be told: names of contexts and of types with functions.
    pub(crate) heads: Vec<Range<usize>>,
}

/// A field of a context.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) context: &'static str,
    pub(crate) name: Part,
    /// The kind's last name.
    pub(crate) kind: Part,
    pub(crate) types: Vec<Part>,
    /// Without quotes, as are their bytes.
    pub(crate) literals: Vec<Part>,
    /// Whether it says unit or range.
    pub(crate) has_hints: bool,
    /// Bytes of the whole field.
    pub(crate) bytes: Range<usize>,
}

/// A text and its bytes.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) text: String,
    pub(crate) bytes: Range<usize>,
}

/// A type of the workspace.
#[derive(Clone, Debug)]
pub(crate) enum Definition {
    Struct {
        generics: Vec<String>,
        /// Name, type, whether it is public, whether it is only stored if serde says so.
        fields: Vec<(String, String, bool)>,
        /// Its fields are read by derived serde without further attributes.
        plain: bool,
    },
    Enum {
        /// Names of the variants if none has data.
        variants: Option<Vec<String>>,
    },
}

/// A function of the node.
#[derive(Clone, Debug)]
pub(crate) struct Function {
    pub(crate) name: String,
    /// From its visibility to the end of what it returns.
    pub(crate) bytes: Range<usize>,
    pub(crate) public: bool,
    pub(crate) qualified: bool,
    /// `&mut self`, `self`…, or nothing.
    pub(crate) receiver: Option<String>,
    /// Types of the other arguments, with whether hardware stands behind them.
    pub(crate) arguments: Vec<(String, bool)>,
    pub(crate) returns: String,
}

impl File {
    /// Reads a text; `None` if it is no Rust.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let syntax = syn::parse_file(text).ok()?;
        let mut file = Self::default();
        for item in &syntax.items {
            match item {
                Item::Struct(item) => file.add_struct(item),
                Item::Enum(item) => {
                    let unit = item.variants.iter().all(|one| one.fields == Fields::Unit);
                    let names = item.variants.iter().map(|one| one.ident.to_string());
                    let variants = unit.then(|| names.collect());
                    file.types
                        .insert(item.ident.to_string(), Definition::Enum { variants });
                }
                _ => {}
            }
        }
        file.add_node(&syntax);
        Some(file)
    }

    fn add_struct(&mut self, item: &syn::ItemStruct) {
        let Fields::Named(named) = &item.fields else {
            return;
        };
        if let Some(context) = CONTEXTS.iter().find(|name| item.ident == **name) {
            self.heads.push(item.ident.span().byte_range());
            self.ends
                .insert(context, named.brace_token.span.close().byte_range().start);
            let fields = named
                .named
                .iter()
                .filter_map(|field| read_field(context, field));
            self.fields.extend(fields);
            return;
        }
        let fields = named.named.iter().filter_map(|field| {
            let public = matches!(field.vis, syn::Visibility::Public(_));
            Some((
                field.ident.as_ref()?.to_string(),
                written(&field.ty),
                public,
            ))
        });
        let is_serde = |one: &syn::Attribute| one.path().is_ident("serde");
        let definition = Definition::Struct {
            generics: item
                .generics
                .type_params()
                .map(|one| one.ident.to_string())
                .collect(),
            fields: fields.collect(),
            plain: !named
                .named
                .iter()
                .any(|field| field.attrs.iter().any(is_serde)),
        };
        self.types.insert(item.ident.to_string(), definition);
    }

    fn add_node(&mut self, syntax: &syn::File) {
        let mut by_type: BTreeMap<String, Vec<Function>> = BTreeMap::new();
        for item in &syntax.items {
            let Item::Impl(block) = item else { continue };
            if block.trait_.is_some() {
                continue;
            }
            self.heads.push(block.self_ty.span().byte_range());
            let functions = block.items.iter().filter_map(|item| match item {
                ImplItem::Fn(function) => Some(read_function(function)),
                _ => None,
            });
            by_type
                .entry(written(&block.self_ty))
                .or_default()
                .extend(functions);
        }
        let has = |functions: &[Function], name: &str| functions.iter().any(|one| one.name == name);
        let mut nodes = by_type
            .into_values()
            .filter(|functions| has(functions, "new") && has(functions, "cycle"));
        if let Some(mut functions) = nodes.next() {
            functions.retain(|one| ["new", "cycle", "restore"].contains(&one.name.as_str()));
            self.functions = functions;
        }
    }

    /// Fields of one context.
    pub(crate) fn of(&self, context: &'static str) -> impl Iterator<Item = &Field> {
        self.fields
            .iter()
            .filter(move |field| field.context == context)
    }

    /// Main outputs, returned and in place.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = &Field> {
        self.fields
            .iter()
            .filter(|field| field.kind.text == "MainOutput")
    }
}

/// The text with blanks in place of what stands in functions and in tests: hulkgen does not look there, and reading them is
/// most of the time. Every byte stays where it is.
pub(crate) fn without_bodies(text: &str) -> String {
    let Ok(syntax) = syn::parse_file(text) else {
        return text.to_owned();
    };
    let tests = syntax.items.iter().filter_map(|item| match item {
        Item::Mod(module) if module.ident == "tests" => {
            module.content.as_ref().map(|(brace, _)| inside(brace))
        }
        _ => None,
    });
    let bodies = bodies(&syntax).map(|(_, block)| inside(&block.brace_token));
    let mut bytes = text.as_bytes().to_vec();
    for byte in tests.chain(bodies).flatten() {
        bytes[byte] = if bytes[byte] == b'\n' { b'\n' } else { b' ' };
    }
    String::from_utf8(bytes).expect("only whole bodies were blanked")
}

/// The text with functions that compile whatever the contexts are: none of them ever returns.
pub(crate) fn with_idle_bodies(text: &str) -> String {
    let Ok(syntax) = syn::parse_file(text) else {
        return text.to_owned();
    };
    // The compiler would run the loop, or look in the body for the type.
    let must_stay = |signature: &Signature| {
        let returned = match &signature.output {
            ReturnType::Type(_, data) => matches!(**data, Type::ImplTrait(_)),
            ReturnType::Default => false,
        };
        signature.constness.is_some() || returned
    };
    let mut idle = text.to_owned();
    let bodies: Vec<_> = bodies(&syntax)
        .filter(|(signature, _)| !must_stay(signature))
        .map(|(_, block)| inside(&block.brace_token))
        .collect();
    // From the end, so that the bytes before stay where they are.
    for body in bodies.into_iter().rev() {
        idle.replace_range(body, " loop {} ");
    }
    idle
}

/// Functions of a file and of its `impl` blocks, in the order of the text.
fn bodies(syntax: &syn::File) -> impl Iterator<Item = (&Signature, &Block)> {
    syntax.items.iter().flat_map(|item| match item {
        Item::Fn(function) => vec![(&function.sig, &*function.block)],
        Item::Impl(implementation) => implementation
            .items
            .iter()
            .filter_map(|item| match item {
                ImplItem::Fn(function) => Some((&function.sig, &function.block)),
                _ => None,
            })
            .collect(),
        _ => Vec::new(),
    })
}

/// The bytes between two braces.
fn inside(brace: &Brace) -> Range<usize> {
    brace.span.open().byte_range().end..brace.span.close().byte_range().start
}

/// `Vec<T>` without its `Vec<…>`, for any name.
pub(crate) fn argument<'t>(data: &'t str, name: &str) -> Option<&'t str> {
    data.strip_prefix(name)?
        .strip_prefix('<')?
        .strip_suffix('>')
}

/// A type by the last names of its paths: `Vec<Point2<f32>>`.
pub(crate) fn written(data: &Type) -> String {
    match data {
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else {
                return "?".to_owned();
            };
            let arguments: Vec<String> = match &last.arguments {
                PathArguments::AngleBracketed(bracketed) => {
                    bracketed.args.iter().map(written_argument).collect()
                }
                _ => Vec::new(),
            };
            match arguments.is_empty() {
                true => last.ident.to_string(),
                false => format!("{}<{}>", last.ident, arguments.join(",")),
            }
        }
        Type::Reference(reference) => format!("&{}", written(&reference.elem)),
        Type::Tuple(tuple) => {
            let parts: Vec<String> = tuple.elems.iter().map(written).collect();
            format!("({})", parts.join(","))
        }
        Type::Array(array) => format!("[{};{}]", written(&array.elem), constant(&array.len)),
        _ => "?".to_owned(),
    }
}

fn written_argument(argument: &GenericArgument) -> String {
    match argument {
        GenericArgument::Type(data) => written(data),
        GenericArgument::Const(value) => constant(value),
        _ => "?".to_owned(),
    }
}

fn constant(value: &Expr) -> String {
    match value {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(number) => number.base10_digits().to_owned(),
            Lit::Str(text) => text.value(),
            _ => "?".to_owned(),
        },
        Expr::Path(path) => path
            .path
            .segments
            .last()
            .map_or("?".to_owned(), |last| last.ident.to_string()),
        _ => "?".to_owned(),
    }
}

fn read_field(context: &'static str, field: &syn::Field) -> Option<Field> {
    let Type::Path(path) = &field.ty else {
        return None;
    };
    let last = path.path.segments.last()?;
    let name = field.ident.as_ref()?;
    let part = |text: String, bytes: Range<usize>| Part { text, bytes };
    let mut read = Field {
        context,
        name: part(name.to_string(), name.span().byte_range()),
        kind: part(last.ident.to_string(), last.ident.span().byte_range()),
        types: Vec::new(),
        literals: Vec::new(),
        has_hints: field.attrs.iter().any(|one| one.path().is_ident("reflect")),
        bytes: name.span().byte_range().start..field.ty.span().byte_range().end,
    };
    if let PathArguments::AngleBracketed(bracketed) = &last.arguments {
        for argument in &bracketed.args {
            let bytes = argument.span().byte_range();
            match argument {
                GenericArgument::Type(data) => read.types.push(part(written(data), bytes)),
                other => {
                    let inside = bytes.start + 1..bytes.end - 1;
                    read.literals.push(part(written_argument(other), inside));
                }
            }
        }
    }
    Some(read)
}

fn read_function(function: &syn::ImplItemFn) -> Function {
    let signature = &function.sig;
    let mut read = Function {
        name: signature.ident.to_string(),
        bytes: function.vis.span().byte_range().start..signature.span().byte_range().end,
        public: matches!(function.vis, syn::Visibility::Public(_)),
        qualified: signature.asyncness.is_some()
            || signature.unsafety.is_some()
            || signature.abi.is_some(),
        receiver: None,
        arguments: Vec::new(),
        returns: match &signature.output {
            ReturnType::Default => String::new(),
            ReturnType::Type(_, data) => written(data),
        },
    };
    if !read.public {
        read.bytes.start = signature.span().byte_range().start;
    }
    for argument in &signature.inputs {
        match argument {
            FnArg::Receiver(receiver) => {
                let reference = if receiver.reference.is_some() {
                    "&"
                } else {
                    ""
                };
                let mutable = if receiver.mutability.is_some() {
                    "mut "
                } else {
                    ""
                };
                read.receiver = Some(format!("{reference}{mutable}self"));
            }
            FnArg::Typed(argument) => {
                let data = written(&argument.ty);
                let (name, hardware) = match data.split_once('<') {
                    Some((name, _)) => (name.to_owned(), true),
                    None => (data.clone(), false),
                };
                read.arguments.push((name, hardware));
            }
        }
    }
    read
}
