//! Shapes as JSON Schema, draft-07, for tools that do not know them.

use serde_json::{Map, Value, json};

use super::{Content, FieldShape, Form, Leaf, Limits, Shape, VariantContent, VariantShape};

const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

impl Shape {
    /// What the serde form of a value looks like in JSON.
    ///
    /// Everything stands where it is used; `definitions` has only types that contain themselves. Titles are names of
    /// types, descriptions come from documentation, `x-unit` is the unit of a field.
    pub fn json_schema(&self) -> Value {
        let mut describe = Describe::default();
        let mut schema = describe.shape(self, None);
        schema.insert("$schema".to_owned(), DRAFT.into());
        if !describe.definitions.is_empty() {
            schema.insert("definitions".to_owned(), describe.definitions.into());
        }
        schema.into()
    }
}

#[derive(Default)]
struct Describe {
    definitions: Map<String, Value>,
}

type Schema = Map<String, Value>;

impl Describe {
    fn shape(&mut self, shape: &Shape, limits: Option<Limits>) -> Schema {
        if let Content::Recursive(expand) = &shape.content {
            return self.reference(shape.type_name, *expand);
        }
        let mut schema = match (&shape.content, shape.form) {
            (Content::Enum(variants), form) => self.variants(shape, variants, form, limits),
            (Content::Struct(fields), form) => self.fields(fields, form, limits),
            (content, _) => self.content(content, limits),
        };
        schema.insert("title".to_owned(), shape.type_name.into());
        if !shape.docs.is_empty() {
            schema.insert("description".to_owned(), shape.docs.into());
        }
        schema
    }

    fn reference(&mut self, name: &str, expand: fn() -> Shape) -> Schema {
        // A JSON pointer, and in a URI: both have characters of their own.
        let key: String = name
            .chars()
            .map(|it| if it.is_alphanumeric() { it } else { '_' })
            .collect();
        if !self.definitions.contains_key(&key) {
            // Known before its parts are, which refer to it.
            self.definitions.insert(key.clone(), Value::Null);
            let expanded = self.shape(&expand(), None);
            self.definitions.insert(key.clone(), expanded.into());
        }
        object([("$ref", format!("#/definitions/{key}").into())])
    }

    fn content(&mut self, content: &Content, limits: Option<Limits>) -> Schema {
        match content {
            Content::Leaf(leaf) => leaf_schema(*leaf, limits),
            Content::Option(inner) => {
                let inner = self.shape(inner, limits);
                object([("anyOf", json!([inner, {"type": "null"}]))])
            }
            Content::List { item, length, .. } => {
                let mut schema = object([
                    ("type", "array".into()),
                    ("items", self.shape(item, limits).into()),
                ]);
                if let Some(length) = length {
                    schema.insert("minItems".to_owned(), (*length).into());
                    schema.insert("maxItems".to_owned(), (*length).into());
                }
                schema
            }
            Content::Set(item) => object([
                ("type", "array".into()),
                ("items", self.shape(item, limits).into()),
                ("uniqueItems", true.into()),
            ]),
            Content::Map(value) => object([
                ("type", "object".into()),
                ("additionalProperties", self.shape(value, limits).into()),
            ]),
            Content::Struct(fields) => self.fields(fields, Form::Plain, limits),
            Content::Tuple(items) => {
                let length = items.len();
                let items = items.iter().map(|item| self.shape(item, limits).into());
                object([
                    ("type", "array".into()),
                    ("items", items.collect::<Vec<Value>>().into()),
                    ("additionalItems", false.into()),
                    ("minItems", length.into()),
                    ("maxItems", length.into()),
                ])
            }
            Content::Enum(_) | Content::Recursive(_) => Schema::new(),
        }
    }

    fn fields(&mut self, fields: &[FieldShape], form: Form, limits: Option<Limits>) -> Schema {
        let mut properties = Schema::new();
        for field in fields {
            properties.insert(field.name.to_owned(), self.field(field, limits).into());
        }
        let required = fields.iter().filter(|field| !field.optional);
        let required: Vec<Value> = required.map(|field| field.name.into()).collect();
        let mut schema = object([("type", "object".into()), ("properties", properties.into())]);
        if !required.is_empty() {
            schema.insert("required".to_owned(), required.into());
        }
        if form.is_plain() {
            schema.insert("additionalProperties".to_owned(), false.into());
        }
        schema
    }

    fn field(&mut self, field: &FieldShape, limits: Option<Limits>) -> Schema {
        let mut schema = self.shape(&field.shape, field.range.or(limits));
        // What stands beside a reference is not read.
        if (!field.docs.is_empty() || field.unit.is_some()) && schema.contains_key("$ref") {
            schema = object([("allOf", json!([schema]))]);
        }
        if !field.docs.is_empty() {
            schema.insert("description".to_owned(), field.docs.into());
        }
        if let Some(unit) = field.unit {
            schema.insert("x-unit".to_owned(), unit.into());
        }
        schema
    }

    fn variants(
        &mut self,
        shape: &Shape,
        variants: &[VariantShape],
        form: Form,
        limits: Option<Limits>,
    ) -> Schema {
        let is_plain_text =
            |it: &VariantShape| matches!(it.content, VariantContent::Unit) && it.docs.is_empty();
        if form.is_plain() && variants.iter().all(is_plain_text) {
            let names: Vec<Value> = variants.iter().map(|variant| variant.name.into()).collect();
            return object([("type", "string".into()), ("enum", names.into())]);
        }
        // Which of its variants are written otherwise, it does not tell.
        if form == Form::Open {
            return Schema::new();
        }
        let schemas = variants.iter().map(|variant| {
            let mut schema = match form {
                Form::Plain | Form::Open => self.named_variant(shape, variant, limits),
                Form::Tagged { tag } => self.tagged_variant(shape, variant, tag, limits),
                Form::Adjacent { tag, content } => {
                    let mut properties = object([(tag, constant(variant.name))]);
                    if let Some(inside) = self.inside(shape, variant, limits) {
                        properties.insert(content.to_owned(), inside.into());
                    }
                    closed(properties)
                }
                Form::Untagged => {
                    let inside = self.inside(shape, variant, limits);
                    inside.unwrap_or_else(|| object([("type", "null".into())]))
                }
            };
            if !variant.docs.is_empty() {
                schema.insert("description".to_owned(), variant.docs.into());
            }
            Value::from(schema)
        });
        let schemas: Vec<Value> = schemas.collect();
        object([("anyOf", schemas.into())])
    }

    /// As serde writes it unless it is told otherwise.
    fn named_variant(
        &mut self,
        shape: &Shape,
        variant: &VariantShape,
        limits: Option<Limits>,
    ) -> Schema {
        match self.inside(shape, variant, limits) {
            None => object([("const", variant.name.into())]),
            Some(inside) => closed(object([(variant.name, inside.into())])),
        }
    }

    fn tagged_variant(
        &mut self,
        shape: &Shape,
        variant: &VariantShape,
        tag: &str,
        limits: Option<Limits>,
    ) -> Schema {
        let name = constant(variant.name);
        let Some(mut schema) = self.inside(shape, variant, limits) else {
            return closed(object([(tag, name)]));
        };
        let Some(Value::Object(properties)) = schema.get_mut("properties") else {
            // A map or an enum: the tag is what is known.
            return object([
                ("type", "object".into()),
                ("properties", json!({ tag: name })),
                ("required", json!([tag])),
            ]);
        };
        properties.insert(tag.to_owned(), name);
        match schema.get_mut("required") {
            Some(Value::Array(required)) => required.push(tag.into()),
            _ => _ = schema.insert("required".to_owned(), json!([tag])),
        }
        schema
    }

    /// What a variant holds; `None` if that is nothing.
    fn inside(
        &mut self,
        shape: &Shape,
        variant: &VariantShape,
        limits: Option<Limits>,
    ) -> Option<Schema> {
        match &variant.content {
            VariantContent::Unit => None,
            VariantContent::Value(inside) => Some(self.shape(inside, limits)),
            VariantContent::Fields(content) => {
                let mut schema = self.content(content, limits);
                schema.insert(
                    "title".to_owned(),
                    format!("{}::{}", shape.type_name, variant.name).into(),
                );
                Some(schema)
            }
        }
    }
}

fn leaf_schema(leaf: Leaf, limits: Option<Limits>) -> Schema {
    let mut schema = match leaf {
        Leaf::Opaque => Schema::new(),
        Leaf::Bool => object([("type", "boolean".into())]),
        Leaf::Character => object([
            ("type", "string".into()),
            ("minLength", 1.into()),
            ("maxLength", 1.into()),
        ]),
        Leaf::Text => object([("type", "string".into())]),
        Leaf::Unit => object([("type", "null".into())]),
        Leaf::Float { .. } => object([("type", "number".into())]),
        Leaf::Signed { bits } => {
            let mut schema = object([("type", "integer".into())]);
            if let Some(half) = 1_i64.checked_shl(bits - 1).filter(|_| bits < 64) {
                schema.insert("minimum".to_owned(), (-half).into());
                schema.insert("maximum".to_owned(), (half - 1).into());
            }
            schema
        }
        Leaf::Unsigned { bits } => {
            let mut schema = object([("type", "integer".into()), ("minimum", 0.into())]);
            if let Some(end) = 1_u64.checked_shl(bits).filter(|_| bits < 64) {
                schema.insert("maximum".to_owned(), (end - 1).into());
            }
            schema
        }
        Leaf::Duration => closed(object([
            (
                "secs",
                leaf_schema(Leaf::Unsigned { bits: 64 }, None).into(),
            ),
            (
                "nanos",
                json!({"type": "integer", "minimum": 0, "maximum": 999_999_999}),
            ),
        ])),
    };
    let is_number = matches!(
        leaf,
        Leaf::Float { .. } | Leaf::Signed { .. } | Leaf::Unsigned { .. }
    );
    if let Some(limits) = limits.filter(|_| is_number) {
        limit(&mut schema, leaf, limits);
    }
    schema
}

fn limit(schema: &mut Schema, leaf: Leaf, limits: Limits) {
    // What a float of 32 bits has for a bound may lie just beyond it.
    let limits = match leaf {
        Leaf::Float { bits: 32 } => limits.rounded(),
        _ => limits,
    };
    if let Some(minimum) = limits.minimum {
        schema.insert("minimum".to_owned(), minimum.into());
    }
    if let Some(maximum) = limits.maximum {
        let word = if limits.is_half_open {
            "exclusiveMaximum"
        } else {
            "maximum"
        };
        schema.remove("maximum");
        schema.insert(word.to_owned(), maximum.into());
    }
}

/// An object with exactly these properties.
fn closed(properties: Schema) -> Schema {
    let required: Vec<Value> = properties.keys().map(|name| name.as_str().into()).collect();
    object([
        ("type", "object".into()),
        ("properties", properties.into()),
        ("required", required.into()),
        ("additionalProperties", false.into()),
    ])
}

fn constant(name: &str) -> Value {
    json!({ "const": name })
}

fn object<const N: usize>(entries: [(&str, Value); N]) -> Schema {
    let entries = entries.map(|(key, value)| (key.to_owned(), value));
    entries.into_iter().collect()
}
