#include "tests/support/modelica_text.h"
#include <cctype>
#include <set>
#include <stdexcept>

namespace modelica {
namespace {
struct Token {
  enum Kind { name, number, text, sign, end } kind = end;
  std::string is;
  int line = 1, column = 1;
};

const std::set<std::string> keywords{
    "algorithm", "and",   "annotation", "connect", "constant", "der",      "discrete",  "each",    "else",
    "elseif",    "end",   "equation",   "extends", "final",    "for",      "if",        "import",  "in",
    "initial",   "input", "loop",       "model",   "not",      "or",       "output",    "package", "parameter",
    "then",      "when",  "within",     "true",    "false",    "elsewhen", "protected", "public"};

class Reader {
public:
  explicit Reader(const std::string &text) : text_(text)
  {
    next();
  }

  Class stored_definition()
  {
    if (accept("within")) {
      if (!is(";"))
        dotted_name();
      expect(";");
    }
    Class whole = class_definition();
    expect(";");
    if (now_.kind != Token::end)
      fail("the end of the file");
    return whole;
  }

private:
  [[noreturn]] void fail(const std::string &expected) const
  {
    throw std::runtime_error(std::to_string(now_.line) + ":" + std::to_string(now_.column) + ": " + expected +
                             " is expected in place of \"" + now_.is + "\"");
  }
  char at(const std::size_t ahead = 0) const
  {
    return place_ + ahead < text_.size() ? text_[place_ + ahead] : '\0';
  }
  char step()
  {
    const char c = at();
    ++place_;
    c == '\n' ? (++line_, column_ = 1) : ++column_;
    return c;
  }
  void skip()
  {
    for (;;) {
      while (at() && std::isspace(static_cast<unsigned char>(at())))
        step();
      if (at() == '/' && at(1) == '/')
        while (at() && at() != '\n')
          step();
      else if (at() == '/' && at(1) == '*') {
        while (at() && !(at() == '*' && at(1) == '/'))
          step();
        step(), step();
      } else
        return;
    }
  }
  void next()
  {
    skip();
    now_         = {Token::end, "", line_, column_};
    const char c = at();
    if (!c)
      return;
    if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') {
      now_.kind = Token::name;
      while (std::isalnum(static_cast<unsigned char>(at())) || at() == '_')
        now_.is += step();
    } else if (std::isdigit(static_cast<unsigned char>(c)))
      read_number();
    else if (c == '"') {
      now_.kind = Token::text;
      step();
      while (at() && at() != '"') {
        if (at() == '\\')
          step();
        now_.is += step();
      }
      if (!at())
        fail("the end of a text");
      step();
    } else {
      now_.kind = Token::sign;
      now_.is   = step();
      if ((now_.is == "<" || now_.is == ">" || now_.is == "=") && at() == '=')
        now_.is += step();
      else if (now_.is == "<" && at() == '>')
        now_.is += step();
    }
  }
  void read_number()
  {
    now_.kind         = Token::number;
    const auto digits = [&] {
      if (!std::isdigit(static_cast<unsigned char>(at())))
        fail("a digit");
      while (std::isdigit(static_cast<unsigned char>(at())))
        now_.is += step();
    };
    digits();
    if (at() == '.') {
      now_.is += step();
      while (std::isdigit(static_cast<unsigned char>(at())))
        now_.is += step();
    }
    if (at() == 'e' || at() == 'E') {
      now_.is += step();
      if (at() == '+' || at() == '-')
        now_.is += step();
      digits();
    }
  }
  bool is(const char *what) const
  {
    return (now_.kind == Token::sign || now_.kind == Token::name) && now_.is == what;
  }
  bool accept(const char *what)
  {
    if (!is(what))
      return false;
    next();
    return true;
  }
  void expect(const char *what)
  {
    if (!accept(what))
      fail(std::string("\"") + what + "\"");
  }
  std::string identifier()
  {
    if (now_.kind != Token::name || keywords.count(now_.is))
      fail("a name");
    std::string name = now_.is;
    next();
    return name;
  }
  std::string dotted_name()
  {
    std::string name = identifier();
    while (accept("."))
      name += "." + identifier();
    return name;
  }
  std::string comment()
  {
    std::string text;
    if (now_.kind == Token::text) {
      text = now_.is;
      next();
    }
    return text;
  }

  Class class_definition()
  {
    Class c;
    c.kind = now_.is;
    if (!accept("package") && !accept("model"))
      fail("package or model");
    c.name       = identifier();
    c.comment    = comment();
    bool initial = false, in_equations = false;
    while (!is("end")) {
      if (accept("annotation")) {
        arguments(c.annotations, "");
        expect(";");
      } else if (is("initial") || is("equation")) {
        initial = accept("initial");
        expect("equation");
        in_equations = true;
      } else if (in_equations) {
        equation(c, initial ? c.initial_equations : c.equations);
        comment();
        expect(";");
      } else if (is("package") || is("model")) {
        Class inner = class_definition();
        expect(";");
        if (!c.classes.emplace(inner.name, std::move(inner)).second)
          fail("a class of another name");
      } else
        component_clause(c);
    }
    expect("end");
    if (identifier() != c.name)
      fail("the name of the class at its end");
    return c;
  }

  void component_clause(Class &c)
  {
    Component one;
    for (const char *prefix : {"parameter", "constant", "discrete", "input", "output"})
      if (accept(prefix))
        one.prefix = prefix;
    one.type = dotted_name();
    for (bool more = true; more;) {
      Component component;
      component.prefix       = one.prefix;
      component.type         = one.type;
      const std::string name = identifier();
      if (is("["))
        component.dimensions = subscripts();
      if (is("("))
        arguments(component.modifiers, "");
      if (accept("="))
        component.value = std::make_unique<Expression>(expression());
      component.comment = comment();
      if (!c.components.emplace(name, std::move(component)).second)
        fail("a component of another name than " + name);
      c.order.push_back(name);
      more = accept(",");
    }
    expect(";");
  }

  void arguments(std::map<std::string, Expression> &into, const std::string &prefix)
  {
    expect("(");
    while (!is(")")) {
      accept("each");
      accept("final");
      const std::string name = prefix + dotted_name();
      if (is("("))
        arguments(into, name + ".");
      if (accept("=") && !into.emplace(name, expression()).second)
        fail("one value of " + name);
      comment();
      if (!is(")"))
        expect(",");
    }
    expect(")");
  }

  std::vector<Expression> subscripts()
  {
    std::vector<Expression> list;
    expect("[");
    do
      list.push_back(is(":") ? (next(), Expression{"all", "", 0, {}}) : expression());
    while (accept(","));
    expect("]");
    return list;
  }

  void equation(Class &c, std::vector<Equation> &into)
  {
    if (accept("for")) {
      const std::string index = identifier();
      expect("in");
      const int first = int(simple().number);
      expect(":");
      const int last = int(simple().number);
      expect("loop");
      std::vector<Equation> body;
      while (!is("end")) {
        equation(c, body);
        expect(";");
      }
      expect("end");
      expect("for");
      for (int i = first; i <= last; ++i)
        for (const Equation &e : body)
          into.push_back({unrolled(e.left, index, i), unrolled(e.right, index, i)});
      return;
    }
    if (accept("connect")) {
      expect("(");
      const std::string from = dotted_name();
      expect(",");
      c.connections.emplace_back(from, dotted_name());
      expect(")");
      return;
    }
    if (accept("when")) {
      expression();
      expect("then");
      std::vector<Equation> body;
      while (!is("end")) {
        equation(c, body);
        expect(";");
      }
      expect("end");
      expect("when");
      return;
    }
    Expression left = simple();
    expect("=");
    into.push_back({std::move(left), expression()});
  }

  static Expression unrolled(const Expression &e, const std::string &index, const int i)
  {
    if (e.what == "name" && e.text == index)
      return {"number", "", double(i), {}};
    Expression out = e;
    for (Expression &part : out.of)
      part = unrolled(part, index, i);
    return out;
  }

  Expression expression()
  {
    if (!accept("if"))
      return simple();
    Expression choice{"if", "", 0, {expression()}};
    expect("then");
    choice.of.push_back(expression());
    expect("else");
    choice.of.push_back(expression());
    return choice;
  }
  Expression simple()
  {
    Expression left = sum();
    for (const char *relation : {"<", "<=", ">", ">=", "==", "<>"})
      if (is(relation)) {
        next();
        return {relation, "", 0, {std::move(left), sum()}};
      }
    return left;
  }
  Expression sum()
  {
    Expression left = is("-") ? (next(), Expression{"negative", "", 0, {product()}}) : (accept("+"), product());
    while (is("+") || is("-")) {
      const std::string sign = now_.is;
      next();
      left = {sign, "", 0, {std::move(left), product()}};
    }
    return left;
  }
  Expression product()
  {
    Expression left = power();
    while (is("*") || is("/")) {
      const std::string sign = now_.is;
      next();
      left = {sign, "", 0, {std::move(left), power()}};
    }
    return left;
  }
  Expression power()
  {
    Expression base = primary();
    return accept("^") ? Expression{"^", "", 0, {std::move(base), primary()}} : base;
  }
  Expression list(const char *open, const char *close, const char *what)
  {
    Expression all{what, "", 0, {}};
    expect(open);
    while (!is(close)) {
      // Named arguments of a call: f(a = 1).
      Expression item = expression();
      if (accept("="))
        item = expression();
      all.of.push_back(std::move(item));
      if (!is(close))
        expect(",");
    }
    expect(close);
    return all;
  }
  Expression table()
  {
    Expression rows{"table", "", 0, {}};
    expect("[");
    do {
      Expression row{"array", "", 0, {}};
      do
        row.of.push_back(expression());
      while (accept(","));
      rows.of.push_back(std::move(row));
    } while (accept(";"));
    expect("]");
    return rows;
  }
  Expression primary()
  {
    if (now_.kind == Token::number) {
      Expression e{"number", "", std::stod(now_.is), {}};
      next();
      return e;
    }
    if (now_.kind == Token::text) {
      Expression e{"text", now_.is, 0, {}};
      next();
      return e;
    }
    if (is("true") || is("false")) {
      Expression e{"number", "", is("true") ? 1. : 0., {}};
      next();
      return e;
    }
    if (is("{"))
      return list("{", "}", "array");
    if (is("["))
      return table();
    if (accept("(")) {
      Expression e = expression();
      expect(")");
      return e;
    }
    const bool derivative  = accept("der");
    const std::string name = derivative ? "der" : dotted_name();
    if (is("(")) {
      Expression call = list("(", ")", "call");
      call.text       = name;
      return call;
    }
    Expression e{"name", name, 0, {}};
    if (is("[")) {
      Expression indexed{"index", "", 0, {std::move(e)}};
      for (Expression &subscript : subscripts())
        indexed.of.push_back(std::move(subscript));
      while (accept("."))
        identifier();
      return indexed;
    }
    return e;
  }

  const std::string &text_;
  std::size_t place_ = 0;
  int line_ = 1, column_ = 1;
  Token now_;
};
}  // namespace

Class read(const std::string &text)
{
  return Reader(text).stored_definition();
}
}  // namespace modelica
