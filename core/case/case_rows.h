#pragma once
#include "core/case/fields.h"
#include "core/records/key_list.h"
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mill {
/// Values to put in the place of the present one: above, below and far from a number, every other word of a
/// choice. An absent number or table becomes one; an absent text stays absent, since it names what is not there.
/// @param form  "a | b" for words; of others it does not matter
std::vector<Value> other_values(Kind kind, const std::string &form, const Value &now);

/// Rows of a case together with the records that hold their values, so that each can be changed and put back.
class CaseRows {
public:
  /// Rows whose record is stored in the form in which it is written.  The record outlives this object.
  /// @param section  full name, "bearing.trb", "pass.0"
  template <class T> void add(const std::string &section, const std::vector<Field<T>> &fields, T &record)
  {
    add(
        section, fields, record, [](const T &kept) { return kept; },
        [](const T &changed, T &kept) {
          kept = changed;
          return true;
        });
  }

  /// Rows of a record that is written in another form.
  /// @param written  (record) -> T
  /// @param take     (T, record) -> bool: the record with the values of T; false, and no change, where a case of
  ///                 that kind is refused
  template <class T, class Record, class Written, class Take>
  void add(const std::string &section, const std::vector<Field<T>> &fields, Record &record, Written written,
           Take take)
  {
    sections_.push_back(
        std::make_unique<RowsOfRecord<T, Record, Written, Take>>(section, fields, record, written, take));
  }

  /// Keys of the rows whose change, each by itself, moves a text of the records; in the order in which the rows
  /// were added.  Where all numbers of a section together move nothing, its words alone are searched: a choice may
  /// hide what another row moves.
  /// @param text  of the present state of the records; must not throw
  /// Cost: three texts for every row that does not move it, one for the others.
  KeyList moving(const std::function<std::string()> &text);

  /// Full names of all rows, "pass.0.load".
  KeyList keys() const;

private:
  // The rows of one section.
  struct Rows {
    std::string section;
    explicit Rows(std::string name) : section(std::move(name)) {}
    virtual ~Rows()                                          = default;
    virtual std::size_t size() const                         = 0;
    virtual const char *key(std::size_t row) const           = 0;
    virtual std::vector<Value> others(std::size_t row) const = 0;
    virtual bool change(std::size_t row, const Value &value) = 0;  // false: refused
    virtual void restore()                                   = 0;
  };

  template <class T, class Record, class Written, class Take> struct RowsOfRecord : Rows {
    RowsOfRecord(const std::string &name, const std::vector<Field<T>> &rows, Record &of_case, const Written &write,
                 const Take &back)
        : Rows(name), fields(rows), record(of_case), before(of_case), written(write), take(back)
    {
    }
    std::size_t size() const override
    {
      return fields.size();
    }
    const char *key(const std::size_t row) const override
    {
      return fields[row].key;
    }
    std::vector<Value> others(const std::size_t row) const override
    {
      const Field<T> &field = fields[row];
      const auto *choice    = std::get_if<ChoiceMember<T>>(&field.member);
      const Value now       = member_value(field, written(before));
      return choice ? other_values(choice->kind, choice->choices, now)
                    : other_values(kind_of(field.member.index(), field.form), field.form, now);
    }
    bool change(const std::size_t row, const Value &value) override
    {
      T changed = written(record);
      set_member(fields[row], value, changed);
      return take(changed, record);
    }
    void restore() override
    {
      record = before;
    }
    const std::vector<Field<T>> &fields;
    Record &record;
    const Record before;
    Written written;
    Take take;
  };

  std::vector<std::unique_ptr<Rows>> sections_;
};
}  // namespace mill
