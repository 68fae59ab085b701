#include "cli/forcing.h"

#include <algorithm>

namespace plumb::cli {
namespace {

// As they are typed.
std::string word_of(PlanItem item) {
  std::string word = name_of(item);
  std::replace(word.begin(), word.end(), ' ', '_');
  std::replace(word.begin(), word.end(), '-', '_');
  return word;
}

std::string words_for(Choice choice) {
  std::string words;
  for (std::size_t k = 0; k < kPlanItemCount; ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    if (may_force(item, choice)) words += (words.empty() ? "" : ", ") + word_of(item);
  }
  return words;
}

std::string force_all(const std::vector<std::string>& names, Choice choice, PlanChoices& forced) {
  const std::string option = choice == Choice::Off ? "--without" : "--with";
  for (const std::string& name : names) {
    const std::optional<PlanItem> item = plan_item_of(name);
    if (!item || !may_force(*item, choice))
      return option + ": '" + name + "' is none of " + words_for(choice);
    forced.set(*item, choice);
  }
  return {};
}

}  // namespace

std::string force(const ForcedNames& names, WorldSettings& settings) {
  for (const std::string& name : names.off)
    if (std::find(names.on.begin(), names.on.end(), name) != names.on.end())
      return "'" + name + "' is forced both off and on; keep one of --without and --with";
  PlanChoices forced = settings.forced;
  std::string wrong = force_all(names.off, Choice::Off, forced);
  if (wrong.empty()) wrong = force_all(names.on, Choice::On, forced);
  if (wrong.empty()) settings.forced = forced;
  return wrong;
}

}  // namespace plumb::cli
